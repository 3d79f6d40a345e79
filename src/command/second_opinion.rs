//! `zerkalo second-opinion SCENE...`: what POV-Ray makes of the same scenes.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result};
use clap::Args;
use glam::DVec3;
use serde::Serialize;
use serde_json::json;

use super::interrupt::Listener;
use super::options::parse_size;
use super::{ReadingArgs, print_line, progress_bar};
use crate::frame::Frame;
use crate::measure::output::{Document, Table, check_table_path};
use crate::measure::{Difference, error_map};
use crate::reference::{self, Image64, RenderError};
use crate::scene::Scene;
use crate::scene::format::{Export, Reading, exposure_below};
use crate::tracer::TracerError;

/// Largest difference of a linear channel, off discontinuities, that is no disagreement. POV-Ray's own intersections are
/// kept to a millionth of a length, and its picture to half of 1/65535 of its exposure.
const TOLERANCE: f64 = 1e-3;

/// Compare the reference's pictures with POV-Ray's
///
/// Each scene is written for POV-Ray 3.7, drawn by it in 16 bits and compared with the reference, pixels beside an edge
/// apart. Exits with 1 where they differ by more than 1e-3.
#[derive(Debug, Clone, Args)]
pub struct SecondOpinionArgs {
    /// Scene files (.toml, .json, .zscene, .nff) or names of `zerkalo gallery`
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Pixels, each side 1 to 16384 [default: what the scene's file says, else 405x175]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// POV-Ray's program
    #[arg(long, value_name = "PROGRAM", default_value = "povray")]
    pub povray: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    /// Where to write the table (.json, .csv, .md); may be repeated
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// Where to write a picture of the errors of the last scene (.png, .exr)
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    #[command(flatten)]
    pub reading: ReadingArgs,
}

/// What came of one scene.
#[derive(Debug, Serialize)]
struct Opinion {
    scene: String,
    width: u32,
    height: u32,
    /// Largest difference of a linear channel off discontinuities.
    max_abs: f64,
    /// Half a step of POV-Ray's 16 bits, in the scene's intensities.
    half_step: f64,
    /// Pixels off discontinuities.
    smooth: usize,
    /// Of those, by how many it differs by more than the tolerance.
    differing_smooth: usize,
    /// Pixels beside one whose ray went another way.
    discontinuities: usize,
    differing_discontinuities: usize,
    agrees: bool,
    /// What POV-Ray was not told of the scene.
    losses: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Report<'a> {
    judge: &'a str,
    tolerance: f64,
    scenes: &'a [Opinion],
}

impl Document for Report<'_> {
    fn data(&self) -> impl Serialize {
        self
    }

    fn records(&self) -> Table {
        let columns = "scene,width,height,agrees,max_abs,half_step,smooth,differing_smooth,discontinuities,\
                       differing_discontinuities,losses,judge,tolerance";
        let conditions = json!({ "judge": self.judge, "tolerance": self.tolerance });
        Table::of_records(columns, self.scenes.iter().map(|scene| (scene, &conditions)))
    }

    fn blocks(&self) -> Vec<String> {
        let told = format!("- judge: {}\n- tolerance: {:e}", self.judge, self.tolerance);
        let columns = "scene,agrees,largest difference=max_abs,half a step=half_step,pixels=smooth,that differ=differing_smooth,\
                       at edges=discontinuities,that differ there=differing_discontinuities";
        let table = Table::of_records(columns, self.scenes.iter().map(|scene| (scene,)));
        vec!["# A second opinion".to_owned(), told, table.to_markdown()]
    }
}

/// Two renderers do not see the same scene.
#[derive(Debug, thiserror::Error)]
#[error("POV-Ray differs by more than {TOLERANCE:e} on {0}")]
pub struct Disagreement(String);

pub fn run(args: &SecondOpinionArgs) -> Result<()> {
    args.output.iter().try_for_each(|path| check_table_path(path))?;
    args.map.iter().try_for_each(|path| Frame::check_output_path(path))?;
    let judge = version(&args.povray)?;
    let readings = args.scenes.iter().map(|name| args.reading.read(name)).collect::<Result<Vec<_>, _>>()?;
    let listener = Listener::start();
    let bar = progress_bar(readings.len() as u64);
    let mut opinions = Vec::new();
    let mut map = None;
    for (name, Reading { scene, size, .. }) in args.scenes.iter().zip(&readings) {
        let (opinion, errors) = match opinion(args, name, scene, *size, &listener) {
            Err(error) if matches!(error.downcast_ref(), Some(TracerError::Stopped)) => break,
            told => told.with_context(|| format!("scene {name:?}"))?,
        };
        opinions.push(opinion);
        map = Some(errors);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let report = Report { judge: &judge, tolerance: TOLERANCE, scenes: &opinions };
    args.output.iter().try_for_each(|path| report.save(path))?;
    args.map.iter().zip(&map).try_for_each(|(path, map)| map.save(path))?;
    print_line(if args.json { report.to_json() } else { report.to_markdown() }.trim_end())?;
    if opinions.len() < readings.len() {
        return Err(TracerError::Stopped.into());
    }
    let differing: Vec<_> = opinions.iter().filter(|opinion| !opinion.agrees).map(|opinion| &*opinion.scene).collect();
    if differing.is_empty() { Ok(()) } else { Err(Disagreement(differing.join(", ")).into()) }
}

/// POV-Ray's name and version, as it tells them.
fn version(program: &Path) -> Result<String> {
    let run = Command::new(program).arg("--version").stdin(Stdio::null()).output();
    let output = run.map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => anyhow::anyhow!(
            "POV-Ray is not installed: there is no program {program:?} (Debian: apt install povray; Fedora: dnf install \
             povray; Arch: pacman -S povray)"
        ),
        _ => anyhow::anyhow!("could not run {program:?}: {error}"),
    })?;
    let told = String::from_utf8_lossy(&[output.stderr, output.stdout].concat()).into_owned();
    let version = told.lines().find(|line| line.contains("POV-Ray 3"));
    version
        .map(|line| line.trim().to_owned())
        .with_context(|| format!("{program:?} does not tell its version as POV-Ray 3"))
}

fn opinion(
    args: &SecondOpinionArgs,
    name: &str,
    scene: &Scene,
    offered: Option<[u32; 2]>,
    listener: &Listener,
) -> Result<(Opinion, Frame)> {
    let size = args.size.map(|(width, height)| [width, height]).or(offered).unwrap_or([405, 175]);
    let [width, height] = size;
    let truth = reference::render(scene, width, height, &|_| listener.keep_going()).map_err(|error| match error {
        RenderError::Cancelled => anyhow::Error::from(TracerError::Stopped),
        error => error.into(),
    })?;
    let brightest = truth.pixels.iter().map(|pixel| pixel.color.max_element()).fold(0.0, f64::max);
    let exposure = exposure_below(brightest);
    let (picture, losses) = drawn(&args.povray, scene, &Export { size, exposure: Some(exposure), length_scale: None })?;
    anyhow::ensure!([picture.width(), picture.height()] == size, "POV-Ray's picture is of another size");
    let ours: Vec<DVec3> =
        picture.pixels().iter().map(|pixel| DVec3::from_array(pixel.map(f64::from)) / exposure).collect();

    let difference = Difference::between(&truth, &ours, TOLERANCE, |_| true);
    let opinion = Opinion {
        scene: name.to_owned(),
        width,
        height,
        max_abs: difference.largest,
        half_step: 0.5 / 65535.0 / exposure,
        smooth: difference.smooth,
        differing_smooth: difference.differing_smooth,
        discontinuities: difference.discontinuities,
        differing_discontinuities: difference.differing,
        agrees: difference.differing_smooth == 0,
        losses,
    };
    Ok((opinion, map(&truth, &ours)?))
}

/// POV-Ray's picture, in the file's exposure, and what it was not told.
fn drawn(program: &Path, scene: &Scene, export: &Export) -> Result<(Frame, Vec<String>)> {
    let folder = tempfile::tempdir().context("could not create a temporary folder")?;
    let losses = scene.export(&folder.path().join("scene.pov"), export)?;
    let [width, height] = export.size;
    let size = [format!("+W{width}"), format!("+H{height}")];
    // As the file's head says.
    let output = Command::new(program)
        .args(["+Iscene.pov", "+Oscene.png", "+FN16", "-A", "-GA", "-D", "File_Gamma=1.0", "Display_Gamma=1.0"])
        .args(size)
        .current_dir(&folder)
        .stdin(Stdio::null())
        .output()
        .with_context(|| format!("could not run {program:?}"))?;
    if !output.status.success() {
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        let why = told.lines().find(|line| line.contains("rror")).unwrap_or("without a word").trim().to_owned();
        anyhow::bail!("POV-Ray failed: {why}");
    }
    Ok((Frame::load(&folder.path().join("scene.png"))?, losses))
}

fn map(truth: &Image64, ours: &[DVec3]) -> Result<Frame> {
    let mut frames = [Frame::new(truth.width, truth.height)?, Frame::new(truth.width, truth.height)?];
    frames[0].pixels_mut().copy_from_slice(&truth.to_f32());
    for (pixel, color) in frames[1].pixels_mut().iter_mut().zip(ours) {
        *pixel = color.to_array().map(|channel| channel as f32);
    }
    Ok(error_map(&frames[0], &frames[1])?)
}
