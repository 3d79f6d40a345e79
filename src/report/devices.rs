//! The devices of the machine, and what their arithmetic is worth.

use maud::{Markup, html};

use super::text::{both, dash, english, table, yes_no};
use crate::gpu::{Arithmetic, TriedDevice};

pub fn body(devices: &[TriedDevice]) -> Markup {
    html! {
        p {
            (both(
                "Every accurate picture rests on sums and products whose rounding errors are found exactly. Vulkan promises \
                 little of that, so each device is tried.",
                "Точные изображения держатся на суммах и произведениях, ошибки округления которых находятся точно. Vulkan \
                 обещает мало, поэтому каждое устройство проверено делом.",
            ))
        }
        (table(&[both("device", "устройство"), both("kind", "вид"), html! { "Vulkan" }, both("driver", "драйвер"),
            both("GPU time", "время ГП"), both("largest tile", "наибольшая плитка"), both("lacks", "чего нет")],
            &devices.iter().map(device_row).collect::<Vec<_>>()))
        (table(&[both("arithmetic", "арифметика"), both("exact sums", "точные суммы"), both("fused fma", "слитная fma"),
            both("NaN kept", "NaN сохраняется"), both("infinities kept", "бесконечности сохраняются"),
            both("division, ulp", "деление, ulp"), both("square root, ulp", "корень, ulp"),
            both("rounding promised", "округление обещано")],
            &devices.iter().flat_map(arithmetic_rows).collect::<Vec<_>>()))
    }
}

fn device_row(device: &TriedDevice) -> Vec<Markup> {
    let device = &device.description;
    let lacks =
        if device.lacks.is_empty() { both("nothing", "всё есть") } else { english(device.lacks.join(", ")) };
    vec![
        html! { (device.index) " " (device.name) },
        english(device.kind.name()),
        html! { (device.api_version) },
        english(&device.driver),
        yes_no(device.timestamps),
        html! { (device.max_image_side) },
        lacks,
    ]
}

fn arithmetic_rows(device: &TriedDevice) -> Vec<Vec<Markup>> {
    let widths = [("f32", &device.f32_arithmetic), ("f64", &device.f64_arithmetic)];
    let row = |(width, arithmetic): (&str, &Option<Arithmetic>)| {
        let name = html! { (device.description.index) " " (width) };
        let Some(arithmetic) = arithmetic else { return [vec![name], vec![dash(); 7]].concat() };
        vec![
            name,
            yes_no(arithmetic.exact_sums),
            yes_no(arithmetic.fused_fma),
            yes_no(arithmetic.keeps_nan),
            yes_no(arithmetic.keeps_infinity),
            html! { (format!("{:.2}", arithmetic.division_error_ulp)) },
            html! { (format!("{:.2}", arithmetic.square_root_error_ulp)) },
            yes_no(arithmetic.round_to_nearest_declared),
        ]
    };
    widths.map(row).into()
}
