//! Colours, line styles and text sizes.

/// An opaque colour, sRGB.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colour(pub u8, pub u8, pub u8);

/// Colour selector of a curve or an area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// Colour of the theme's palette at this index, modulo its length; also selects the line style.
    Palette(usize),
    /// Palette colour at this index, mixed with the background, for curves in the background; solid line.
    Pale(usize),
    /// Shade of the theme at this index, modulo 4, for areas.
    Shade(usize),
    /// Text colour of the theme.
    Foreground,
    /// Muted colour of the theme, for curves in the background.
    Muted,
    /// Colour of the viridis colour map, 0 (lowest) to 255 (highest), lightened so that texts on it are readable.
    Ramp(u8),
    /// Explicit colour.
    Colour(Colour),
}

/// Dash pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dash {
    /// Solid line.
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

/// Style of a curve. `None` selects the value by the index of the curve in its panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Style {
    /// Ink. `None`: the palette colour at the index of the series.
    pub ink: Option<Ink>,
    /// Dash pattern. `None`: the pattern of the palette index; solid for other inks. Very long curves are always solid.
    pub dash: Option<Dash>,
    /// Line width as a multiple of the theme's line width, 0.1 to 10.
    pub width: f64,
}

/// Colours and sizes of a figure. Lengths are px for a figure 1600 px wide and scale with the width.
#[derive(Debug, Clone, PartialEq)]
pub struct Theme {
    /// Background.
    pub background: Colour,
    /// Texts and frames.
    pub foreground: Colour,
    /// Curves in the background and reference lines.
    pub muted: Colour,
    /// Grid lines.
    pub grid: Colour,
    /// Colours of curves, distinguishable with colour vision deficiencies.
    pub palette: Vec<Colour>,
    /// Colours of adjacent areas, from inconspicuous to conspicuous, distinguishable with colour vision deficiencies and in greyscale.
    pub shades: [Colour; 4],
    /// Fraction of the background colour in pale inks, 0 to 1.
    pub pale: f64,
    /// Size of the title, px per em.
    pub title: f64,
    /// Size of axis labels, px per em.
    pub label: f64,
    /// Size of tick labels and legends, px per em. 29 px are 8.2 pt at a width of 160 mm.
    pub tick: f64,
    /// Width of a curve, px.
    pub line: f64,
}

/// Dash patterns by index, so that curves are distinguishable in greyscale print.
const DASHES: [Dash; 5] = [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::LongDash, Dash::Dotted];

/// Palette by Okabe and Ito, *Color Universal Design* (2008), without yellow, which has too little contrast on white.
const OKABE_ITO: [Colour; 6] = [
    Colour(0x00, 0x72, 0xB2),
    Colour(0xD5, 0x5E, 0x00),
    Colour(0x00, 0x9E, 0x73),
    Colour(0xCC, 0x79, 0xA7),
    Colour(0xE6, 0x9F, 0x00),
    Colour(0x56, 0xB4, 0xE9),
];

/// Samples of the colour map viridis (Smith, van der Walt 2015), which is monotonic in lightness.
pub(crate) const RAMP: [Colour; 9] = [
    Colour(0x44, 0x01, 0x54),
    Colour(0x47, 0x2D, 0x7B),
    Colour(0x3B, 0x52, 0x8B),
    Colour(0x2C, 0x72, 0x8E),
    Colour(0x21, 0x91, 0x8C),
    Colour(0x28, 0xAE, 0x80),
    Colour(0x5E, 0xC9, 0x62),
    Colour(0xAD, 0xDC, 0x30),
    Colour(0xFD, 0xE7, 0x25),
];
/// Fraction of the background colour in [`Ink::Ramp`] colours, so that texts and lines on them are readable.
const WASHED: f64 = 0.45;

/// Palette for dark backgrounds: lighter blue, and yellow in addition.
const DARK: [Colour; 6] = [
    Colour(0x48, 0xA8, 0xF0),
    Colour(0xF5, 0x79, 0x3A),
    Colour(0x00, 0x96, 0x6C),
    Colour(0xFF, 0xB3, 0xE0),
    Colour(0xF0, 0xE4, 0x42),
    Colour(0x80, 0x80, 0xFF),
];

impl Dash {
    /// Returns the dash pattern at an index, modulo the number of patterns.
    pub(crate) fn at(place: usize) -> Self {
        DASHES[place % DASHES.len()]
    }
}

impl Colour {
    /// Mixes in a fraction of another colour.
    fn towards(self, other: Self, share: f64) -> Self {
        let mix = |a: u8, b: u8| (f64::from(a) + share * (f64::from(b) - f64::from(a))).round() as u8;
        Self(mix(self.0, other.0), mix(self.1, other.1), mix(self.2, other.2))
    }
}

impl Theme {
    /// Number of palette colours; later curves repeat them.
    pub(crate) const COLOURS: usize = OKABE_ITO.len();

    /// Creates the theme for print: dark on white.
    pub fn light() -> Self {
        Self {
            background: Colour(0xFF, 0xFF, 0xFF),
            foreground: Colour(0x1A, 0x1A, 0x1A),
            muted: Colour(0x77, 0x77, 0x77),
            grid: Colour(0xE4, 0xE4, 0xE4),
            palette: OKABE_ITO.to_vec(),
            shades: [
                Colour(0xF7, 0xF7, 0xF7),
                Colour(0xC6, 0xCD, 0xD6),
                Colour(0xE6, 0x82, 0x0A),
                Colour(0x1B, 0x4B, 0x8C),
            ],
            pale: 0.68,
            title: 36.0,
            label: 32.0,
            tick: 30.0,
            line: 3.6,
        }
    }

    /// Creates the theme for screens: light on near-black.
    pub fn dark() -> Self {
        Self {
            background: Colour(0x14, 0x17, 0x1C),
            foreground: Colour(0xE8, 0xE8, 0xE8),
            muted: Colour(0x96, 0x9B, 0xA3),
            grid: Colour(0x2E, 0x33, 0x3B),
            palette: DARK.to_vec(),
            shades: [
                Colour(0x1C, 0x20, 0x27),
                Colour(0x48, 0x50, 0x5C),
                Colour(0xF5, 0xB0, 0x41),
                Colour(0x3D, 0x8F, 0xD9),
            ],
            // Two dark colours have less visible contrast than two light ones.
            pale: 0.6,
            ..Self::light()
        }
    }

    /// Returns the colour of an ink in this theme.
    pub(crate) fn colour(&self, ink: Ink) -> Colour {
        let palette = |place: usize| match self.palette.len() {
            0 => self.foreground,
            count => self.palette[place % count],
        };
        match ink {
            Ink::Palette(place) => palette(place),
            Ink::Pale(place) => palette(place).towards(self.background, self.pale),
            Ink::Shade(place) => self.shades[place % self.shades.len()],
            Ink::Foreground => self.foreground,
            Ink::Muted => self.muted,
            Ink::Ramp(share) => {
                let place = f64::from(share) / 255.0 * (RAMP.len() - 1) as f64;
                let below = (place as usize).min(RAMP.len() - 2);
                let colour = RAMP[below].towards(RAMP[below + 1], place - below as f64);
                colour.towards(self.background, WASHED)
            }
            Ink::Colour(colour) => colour,
        }
    }

    /// Returns the colour, dashes and width (px, unscaled) of the curve at an index of its panel.
    pub(crate) fn stroke(&self, style: Style, place: usize) -> Stroke {
        let ink = style.ink.unwrap_or(Ink::Palette(place));
        let dash = match ink {
            Ink::Palette(place) => Dash::at(place),
            _ => Dash::Solid,
        };
        let width = if style.width.is_finite() { style.width.clamp(0.1, 10.0) } else { 1.0 };
        Stroke { colour: self.colour(ink), dash: style.dash.unwrap_or(dash), width: self.line * width }
    }

    /// Returns the text colour for an ink, with more contrast than the ink itself.
    pub(crate) fn lettering(&self, ink: Ink) -> Colour {
        self.colour(ink).towards(self.foreground, 0.3)
    }

    /// Returns the background colour of an axis range that another panel enlarges.
    pub(crate) fn shaded(&self) -> Colour {
        self.background.towards(self.muted, 0.22)
    }

    /// Returns the stroke of a reference line, by the index of its name in the panel.
    pub(crate) fn reference(&self, place: usize) -> Stroke {
        // Solid lines are reserved for curves.
        Stroke { colour: self.muted, dash: Dash::at(1 + place % (DASHES.len() - 1)), width: 0.6 * self.line }
    }
}

impl Default for Style {
    fn default() -> Self {
        Self { ink: None, dash: None, width: 1.0 }
    }
}

/// Resolved line style. Width in px of a figure 1600 px wide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) colour: Colour,
    pub(crate) dash: Dash,
    pub(crate) width: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    type Matrix = [[f64; 3]; 3];

    /// Matrices for linear RGB that simulate normal vision and three colour vision deficiencies of severity 1
    /// (Machado, Oliveira, Fernandes, IEEE Trans. Vis. Comput. Graph. 15 (2009) 1291).
    const SIGHTS: [Matrix; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    ];

    fn linear(Colour(r, g, b): Colour) -> [f64; 3] {
        [r, g, b].map(|v| {
            let v = f64::from(v) / 255.0;
            if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
        })
    }

    /// CIELAB coordinates (D65) of a colour under a simulated vision.
    fn lab(colour: Colour, sight: &Matrix) -> [f64; 3] {
        let light = linear(colour);
        let seen = sight.map(|row| row.iter().zip(light).map(|(m, v)| m * v).sum::<f64>().clamp(0.0, 1.0));
        let sum = |row: [f64; 3]| row.iter().zip(seen).map(|(m, v)| m * v).sum::<f64>();
        let xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]].map(sum);
        let f = |t: f64| if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 };
        let [x, y, z] = [f(xyz[0] / 0.95047), f(xyz[1]), f(xyz[2] / 1.08883)];
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    #[test]
    fn colours_are_told_apart_by_everyone() {
        // A CIELAB difference of 2.3 is just noticeable.
        for theme in [Theme::light(), Theme::dark()] {
            for colours in [theme.palette.as_slice(), &theme.shades] {
                for sight in &SIGHTS {
                    for (i, &a) in colours.iter().enumerate() {
                        for &b in &colours[..i] {
                            let (p, q) = (lab(a, sight), lab(b, sight));
                            let far = p.iter().zip(q).map(|(p, q)| (p - q).powi(2)).sum::<f64>().sqrt();
                            assert!(far > 15.0, "{a:?} {b:?} {far}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn shades_are_told_apart_in_grey() {
        for theme in [Theme::light(), Theme::dark()] {
            let mut lightness = theme.shades.map(|shade| lab(shade, &SIGHTS[0])[0]);
            lightness.sort_by(f64::total_cmp);
            assert!(lightness.windows(2).all(|pair| pair[1] - pair[0] > 15.0), "{lightness:?}");
        }
    }

    #[test]
    fn texts_and_curves_stand_out() {
        // Contrast ratios of WCAG 2.1: 7 for texts, 3 for graphics. The published light palette is slightly below.
        let luminance =
            |colour| linear(colour).iter().zip([0.2126, 0.7152, 0.0722]).map(|(v, m)| v * m).sum::<f64>();
        for (theme, least, least_pale) in [(Theme::light(), 2.1, 1.5), (Theme::dark(), 4.5, 2.0)] {
            let contrast = |colour| {
                let (a, b) = (luminance(colour) + 0.05, luminance(theme.background) + 0.05);
                a.max(b) / a.min(b)
            };
            assert!(contrast(theme.foreground) > 7.0 && contrast(theme.muted) > 3.0);
            assert!(theme.palette.iter().all(|colour| contrast(*colour) > least));
            // Pale bodies must contrast with the background, and arrows and names with pale bodies.
            for place in 0..2 {
                let pale = contrast(theme.colour(Ink::Pale(place)));
                let seen = |colour| (contrast(colour) / pale).max(pale / contrast(colour));
                assert!(pale > least_pale, "{pale}");
                assert!(seen(theme.palette[place]) > 2.5 && seen(theme.foreground) > 6.0, "{pale}");
            }
        }
    }
}
