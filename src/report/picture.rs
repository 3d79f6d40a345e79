//! Pictures and charts inside the page.

use base64::prelude::{BASE64_STANDARD, Engine};
use maud::{Markup, PreEscaped, html};

use crate::frame::{FileFormat, Frame, FrameError};

/// A picture of pixels. `alternative`: what it shows, for those who do not see it.
pub fn image(frame: &Frame, alternative: &str) -> Result<Markup, FrameError> {
    let data = format!("data:image/png;base64,{}", BASE64_STANDARD.encode(frame.encode(FileFormat::Png)?));
    Ok(html! { img src=(data) width=(frame.width()) height=(frame.height()) alt=(alternative); })
}

/// A chart, as plotters draws it; texts in it are escaped already.
pub fn chart(svg: &str, alternative: &str) -> Markup {
    html! { div.scroll.chart role="img" aria-label=(alternative) tabindex="0" { (PreEscaped(svg)) } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_in_the_page_itself() {
        let mut frame = Frame::new(2, 1).unwrap();
        frame.pixels_mut()[1] = [1.0, 0.5, 0.0];
        let markup = image(&frame, "\"two\" pixels").unwrap().into_string();
        let (_, data) = markup.split_once("base64,").unwrap();
        let bytes = BASE64_STANDARD.decode(data.split('"').next().unwrap()).unwrap();
        assert_eq!(bytes, frame.encode(FileFormat::Png).unwrap());
        assert!(markup.ends_with("width=\"2\" height=\"1\" alt=\"&quot;two&quot; pixels\">"), "{markup}");
    }
}
