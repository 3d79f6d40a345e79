//! `zerkalo compare A B`: how far picture B is from picture A.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;
use thiserror::Error;

use crate::frame::{FileFormat, Frame, FrameError};
use crate::measure::{ComparisonError, ErrorDomain, ImageError, Mask, image_error};

/// Compare two images: linear values when both are EXR, display values (8 bits) otherwise.
#[derive(Debug, Clone, Args)]
pub struct CompareArgs {
    /// The reference, PNG or EXR
    pub a: PathBuf,
    /// The image to compare with it
    pub b: PathBuf,
    /// Count only the pixels that are 128 or brighter in this image
    #[arg(long, value_name = "PNG")]
    pub mask: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// Why a comparison failed, in one line.
#[derive(Debug, Error)]
pub enum CompareError {
    /// A picture or the mask cannot be read.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// The pictures do not go together, or the mask not with them.
    #[error("could not compare {a:?} with {b:?}: {reason}")]
    Comparison {
        /// As it was given.
        a: PathBuf,
        /// As it was given.
        b: PathBuf,
        /// The sizes, or a mask that selects nothing.
        reason: ComparisonError,
    },
    /// Standard output takes no more.
    #[error("could not write the comparison")]
    Output(#[from] io::Error),
}

impl CompareError {
    /// Whether the input is at fault, not the machine.
    pub fn is_input_error(&self) -> bool {
        match self {
            Self::Frame(error) => error.is_input_error(),
            Self::Comparison { .. } => true,
            Self::Output(_) => false,
        }
    }
}

/// Loads, compares and prints to stdout.
pub fn run(args: &CompareArgs) -> Result<(), CompareError> {
    let domain = domain_of(args)?;
    let error = compare(args, domain)?;
    let mut output = io::stdout().lock();
    if args.json {
        serde_json::to_writer(&mut output, &error).map_err(io::Error::from)?;
        writeln!(output)?;
    } else {
        write_table(&mut output, &error, domain)?;
    }
    Ok(output.flush()?)
}

/// Linear values exist only where both files keep them.
fn domain_of(args: &CompareArgs) -> Result<ErrorDomain, FrameError> {
    match (FileFormat::of(&args.a)?, FileFormat::of(&args.b)?) {
        (FileFormat::Exr, FileFormat::Exr) => Ok(ErrorDomain::Linear),
        _ => Ok(ErrorDomain::Display),
    }
}

fn compare(args: &CompareArgs, domain: ErrorDomain) -> Result<ImageError, CompareError> {
    let mask = args.mask.as_deref().map(Mask::load).transpose()?;
    let reference = Frame::load(&args.a)?;
    let test = Frame::load(&args.b)?;
    image_error(&reference, &test, domain, mask.as_ref()).map_err(|reason| CompareError::Comparison {
        a: args.a.clone(),
        b: args.b.clone(),
        reason,
    })
}

fn write_table(output: &mut impl Write, error: &ImageError, domain: ErrorDomain) -> io::Result<()> {
    let or_none = |value: Option<f64>| value.map_or("none".to_owned(), |value| format!("{value:.6e}"));
    let psnr = match (error.psnr_db, error.rmse) {
        (Some(psnr_db), _) => format!("{psnr_db:.4} dB"),
        (None, Some(_)) => "infinite".to_owned(),
        (None, None) => "none".to_owned(),
    };
    let values = match domain {
        ErrorDomain::Linear => "linear",
        ErrorDomain::Display => "display, 8 bits",
    };
    writeln!(output, "values             {values}")?;
    writeln!(output, "RMSE               {}", or_none(error.rmse))?;
    writeln!(output, "largest error      {}", or_none(error.max_abs))?;
    writeln!(output, "PSNR               {psnr}")?;
    writeln!(output, "mean FLIP          {:.6}", error.flip_mean)?;
    writeln!(output, "differing pixels   {} of {}", error.differing_pixels, error.pixels)?;
    writeln!(output, "non-finite pixels  {}", error.non_finite_pixels)
}
