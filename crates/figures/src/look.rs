//! How pictures are drawn: as what files, in what colours and size.

use std::sync::{Mutex, PoisonError};
use stickslip_plot::{Figure, PlotError, Theme, draw_animation, draw_png, draw_svg};
use stickslip_scenario::PlotName;

/// The look of pictures; names of their files say what is not the default.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Look {
    /// Kinds of picture files.
    pub formats: Vec<Format>,
    /// Colours: light for paper, dark for screens (`NAME-dark.png`); every picture in each of them.
    pub themes: Vec<Colours>,
    /// Size of the pictures: 1 for 1600 pixels in width, 2 for twice as many (`NAME@2x.png`).
    pub scale: u32,
    /// Width in print, tenths of a millimetre, with letters and lines in points (`NAME-85mm.png`); none: as wide as the page.
    pub width: Option<u32>,
}

/// A kind of picture file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Pixels.
    Png,
    /// Lines and texts, sharp at any size.
    Svg,
}

/// Colours of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Colours {
    /// Dark on white.
    Light,
    /// Light on nearly black.
    Dark,
}

/// A file of a picture: its name and its bytes.
pub type Picture = (String, Vec<u8>);

/// Draws figures in a look, with what they come from.
pub(crate) struct Pen<'a> {
    pub(crate) look: &'a Look,
    pub(crate) provenance: Vec<(String, String)>,
    /// Where figures are kept under their names instead of being drawn.
    pub(crate) kept: Option<Mutex<Vec<(String, Figure<'static>)>>>,
}

impl Format {
    fn ending(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Svg => "svg",
        }
    }
}

impl Look {
    /// Name of a picture's file.
    pub fn file(&self, plot: PlotName, theme: Colours, format: Format) -> String {
        self.file_of(plot.name(), theme, format)
    }

    /// The same of a picture that no scenario can ask for, by its name.
    pub fn file_of(&self, plot: &str, theme: Colours, format: Format) -> String {
        let theme = match theme {
            Colours::Light => "",
            Colours::Dark => "-dark",
        };
        let scale = if self.scale == 1 { String::new() } else { format!("@{}x", self.scale) };
        let width = self.width_in_mm().map_or(String::new(), |mm| format!("-{mm}mm"));
        format!("{plot}{theme}{width}{scale}.{}", format.ending())
    }

    fn width_in_mm(&self) -> Option<f64> {
        self.width.map(|tenths| f64::from(tenths) / 10.0)
    }

    /// Names of all files that any look without a width gives to the pictures of a scenario.
    pub fn all_files() -> Vec<String> {
        let own: Vec<String> = (1..=PlotName::MOST_OWN).map(own_name).collect();
        let names = PlotName::ALL.map(PlotName::name).into_iter().chain(own.iter().map(String::as_str));
        Self::all_files_of(&names.collect::<Vec<_>>())
    }

    /// The same of pictures by their names.
    pub fn all_files_of(plots: &[&str]) -> Vec<String> {
        let mut names = Vec::new();
        for theme in [Colours::Light, Colours::Dark] {
            for scale in [1, 2] {
                let look = Self { formats: Vec::new(), themes: Vec::new(), scale, width: None };
                for format in [Format::Png, Format::Svg] {
                    names.extend(plots.iter().map(|plot| look.file_of(plot, theme, format)));
                }
            }
        }
        names
    }
}

/// Name of the picture of channels over a channel at a place among them, counted from 1.
pub(crate) fn own_name(number: usize) -> String {
    format!("{}-{number}", PlotName::Xy.name())
}

impl Pen<'_> {
    /// Draws a figure, one file for each format.
    pub(crate) fn draw(&self, plot: PlotName, figure: Figure<'_>) -> Result<Vec<Picture>, PlotError> {
        self.draw_as(plot.name(), figure)
    }

    /// Draws figures as an animation under a name of its own, which is a PNG; none where no PNG is asked for.
    #[allow(
        clippy::needless_pass_by_value,
        reason = "a figure is drawn once, in all its themes, and handed over by its builder"
    )]
    pub(crate) fn animate(
        &self,
        plot: &str,
        figures: Vec<Figure<'_>>,
        delay: u16,
    ) -> Result<Vec<Picture>, PlotError> {
        if figures.is_empty() || !self.look.formats.contains(&Format::Png) {
            return Ok(Vec::new());
        }
        let film = |theme: &Colours| {
            let figures: Vec<Figure<'_>> =
                figures.iter().map(|figure| self.looking(figure.clone(), *theme)).collect();
            Ok((self.look.file_of(plot, *theme, Format::Png), draw_animation(&figures, delay)?))
        };
        self.look.themes.iter().map(film).collect()
    }

    /// The figures that it kept.
    pub(crate) fn into_kept(self) -> Vec<(String, Figure<'static>)> {
        self.kept.map_or(Vec::new(), |kept| kept.into_inner().unwrap_or_else(PoisonError::into_inner))
    }

    /// A figure in the look, in one of its colours.
    fn looking<'f>(&self, mut figure: Figure<'f>, theme: Colours) -> Figure<'f> {
        figure = match self.look.width_in_mm() {
            Some(mm) => figure.printed(mm),
            None => {
                let figure = figure.roomy();
                let (width, height) = figure.size;
                Figure { size: (width * self.look.scale, height * self.look.scale), ..figure }
            }
        };
        figure.theme = match theme {
            Colours::Light => Theme::light(),
            Colours::Dark => Theme::dark(),
        };
        figure.provenance.clone_from(&self.provenance);
        figure
    }

    /// The same under a name of its own.
    pub(crate) fn draw_as(&self, plot: &str, figure: Figure<'_>) -> Result<Vec<Picture>, PlotError> {
        if let Some(kept) = &self.kept {
            let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
            kept.push((plot.to_owned(), figure.into_owned()));
            return Ok(Vec::new());
        }
        let mut pictures = Vec::new();
        for &theme in &self.look.themes {
            let figure = self.looking(figure.clone(), theme);
            for &format in &self.look.formats {
                let bytes = match format {
                    Format::Png => draw_png(&figure)?,
                    Format::Svg => draw_svg(&figure)?.into_bytes(),
                };
                pictures.push((self.look.file_of(plot, theme, format), bytes));
            }
        }
        Ok(pictures)
    }
}
