//! Colours, line styles and sizes.

/// An opaque colour, sRGB.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colour(pub u8, pub u8, pub u8);

/// What a curve is drawn with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// The colour at this place of the theme's palette, counted round; its line style comes with it.
    Palette(usize),
    /// The theme's muted ink, for what stands behind.
    Muted,
    /// A colour of one's own.
    Colour(Colour),
}

/// Interruption of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dash {
    /// No interruption.
    #[default]
    Solid,
    /// Dashes.
    Dashed,
    /// Dashes and dots.
    DashDot,
    /// Dots.
    Dotted,
    /// Long dashes.
    LongDash,
}

/// Look of a curve; everything left open follows its place in the panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Style {
    /// Ink; by default the palette at the series' place.
    pub ink: Option<Ink>,
    /// Dashes; by default those that go with the place in the palette, solid for other inks. A curve that fills
    /// an area is drawn solid whatever it says.
    pub dash: Option<Dash>,
    /// Width as a multiple of the theme's line, 0.1 to 10.
    pub width: f64,
}

/// Colours and sizes of a figure. Lengths are px of a figure 1600 px wide and grow with the width.
#[derive(Debug, Clone, PartialEq)]
pub struct Theme {
    /// Behind everything.
    pub background: Colour,
    /// Texts and frames.
    pub foreground: Colour,
    /// Curves that stand behind, reference lines.
    pub muted: Colour,
    /// Grid.
    pub grid: Colour,
    /// Colours of the curves, told apart by the colour-blind too.
    pub palette: Vec<Colour>,
    /// Size of the title, px per em.
    pub title: f64,
    /// Size of axis labels, px per em.
    pub label: f64,
    /// Size of tick labels and legends, px per em; 29 px are 8.2 pt at 16 cm.
    pub tick: f64,
    /// Width of a curve, px.
    pub line: f64,
}

/// Line styles by place: the first palette round solid lines alone would leave a grey print unreadable.
const DASHES: [Dash; 5] = [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::LongDash, Dash::Dotted];

/// Okabe and Ito, *Color Universal Design* (2008), without the yellow, which white swallows.
const OKABE_ITO: [Colour; 6] = [
    Colour(0x00, 0x72, 0xB2),
    Colour(0xD5, 0x5E, 0x00),
    Colour(0x00, 0x9E, 0x73),
    Colour(0xCC, 0x79, 0xA7),
    Colour(0xE6, 0x9F, 0x00),
    Colour(0x56, 0xB4, 0xE9),
];

impl Theme {
    /// Dark on white, for paper.
    pub fn light() -> Self {
        Self {
            background: Colour(0xFF, 0xFF, 0xFF),
            foreground: Colour(0x1A, 0x1A, 0x1A),
            muted: Colour(0x77, 0x77, 0x77),
            grid: Colour(0xE4, 0xE4, 0xE4),
            palette: OKABE_ITO.to_vec(),
            title: 36.0,
            label: 32.0,
            tick: 30.0,
            line: 3.6,
        }
    }

    /// Colour, dashes and width (px before scaling) of the curve at a place of its panel.
    pub(crate) fn stroke(&self, style: Style, place: usize) -> Stroke {
        let ink = style.ink.unwrap_or(Ink::Palette(place));
        let (colour, dash) = match ink {
            Ink::Palette(place) if self.palette.is_empty() => (self.foreground, DASHES[place % DASHES.len()]),
            Ink::Palette(place) => (self.palette[place % self.palette.len()], DASHES[place % DASHES.len()]),
            Ink::Muted => (self.muted, Dash::Solid),
            Ink::Colour(colour) => (colour, Dash::Solid),
        };
        let width = if style.width.is_finite() { style.width.clamp(0.1, 10.0) } else { 1.0 };
        Stroke { colour, dash: style.dash.unwrap_or(dash), width: self.line * width }
    }

    /// The stroke of reference lines.
    pub(crate) fn reference(&self) -> Stroke {
        Stroke { colour: self.muted, dash: Dash::Dashed, width: 0.6 * self.line }
    }
}

impl Default for Style {
    fn default() -> Self {
        Self { ink: None, dash: None, width: 1.0 }
    }
}

/// A line ready to be drawn: width in px of a figure 1600 px wide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) colour: Colour,
    pub(crate) dash: Dash,
    pub(crate) width: f64,
}
