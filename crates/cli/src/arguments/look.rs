//! How pictures are to be drawn, on the command line.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use stickslip_figures::{Colours, Format, Look};
use stickslip_scenario::quantity;

/// The look of pictures; names of their files say what is not the default.
#[derive(Debug, Clone, Args)]
pub(crate) struct LookArguments {
    /// File formats of plots
    #[arg(long = "format", value_name = "KIND,…", value_delimiter = ',', default_value = "png")]
    formats: Vec<FormatArgument>,
    /// Colour themes: light for paper, dark for screens (file NAME-dark.png), or both
    #[arg(long = "theme", value_name = "NAME,…", value_delimiter = ',', default_value = "light")]
    themes: Vec<ColoursArgument>,
    /// Image size: 1 for a width of 1600 pixels, 2 for a width of 3200 pixels (file NAME@2x.png)
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = scales())]
    scale: u32,
    /// Width in print, 60mm to 300mm, such as 85mm (file NAME-85mm.png). The font size in points does not depend on the width. PNG files
    /// have 600 dpi
    #[arg(long, value_name = "LENGTH", value_parser = width, conflicts_with = "scale")]
    width: Option<u32>,
    /// No title above the plot, for a figure with a caption
    #[arg(long)]
    no_title: bool,
}

/// Reads a width in print, in tenths of a millimetre.
fn width(text: &str) -> Result<u32, String> {
    let tenths = (quantity(text, "m")? * 1e4).round();
    if (600.0..=3000.0).contains(&tenths) {
        Ok(tenths as u32)
    } else {
        Err("expected a width from 60mm to 300mm".to_owned())
    }
}

/// Reads a size.
fn scales() -> impl TypedValueParser<Value = u32> {
    PossibleValuesParser::new(["1", "2"]).try_map(|given| given.parse::<u32>())
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FormatArgument {
    /// Pixel image
    Png,
    /// Vector graphics, sharp at any size
    Svg,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ColoursArgument {
    /// Dark on white
    Light,
    /// Light on nearly black
    Dark,
}

impl LookArguments {
    /// What is asked for.
    pub(crate) fn look(&self) -> Look {
        let format = |format: &FormatArgument| match format {
            FormatArgument::Png => Format::Png,
            FormatArgument::Svg => Format::Svg,
        };
        let colours = |theme: &ColoursArgument| match theme {
            ColoursArgument::Light => Colours::Light,
            ColoursArgument::Dark => Colours::Dark,
        };
        let mut themes = Vec::new();
        for theme in self.themes.iter().map(colours) {
            // One named twice is drawn once.
            if !themes.contains(&theme) {
                themes.push(theme);
            }
        }
        Look {
            formats: self.formats.iter().map(format).collect(),
            themes,
            scale: self.scale,
            width: self.width,
            title: !self.no_title,
        }
    }
}
