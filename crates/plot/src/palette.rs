//! Indexed images: one byte per pixel instead of three.
//!
//! Line art has few colours, mainly inks and their mixtures from anti-aliasing. Indexed images compress faster and smaller.

/// Red, green, blue.
pub(crate) type Rgb = [u8; 3];

/// Colour as an integer with red in the lowest byte. The highest byte is the same for all pixels of an image.
pub(crate) type Word = u32;

/// Maximum number of palette colours.
const MOST: usize = 256;
/// Maximum difference of a colour from its palette colour per channel, in increasing steps. Mixed colours of crossing
/// lines are merged within this difference.
const NEAR: [u8; 4] = [1, 2, 4, 6];

/// Image with a colour palette.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Indexed {
    /// Palette of at most 256 colours.
    pub(crate) palette: Vec<Rgb>,
    /// Palette index of each pixel, row by row.
    pub(crate) pixels: Vec<u8>,
}

/// Number of slots of the hash table, a power of two. A picture with more than half as many colours has no palette.
const SLOTS: usize = 1 << 14;
/// Multiplier of the hash function, an odd number near 2³² divided by the golden ratio (Knuth, The Art of Computer Programming 3, 6.4).
const SPREAD: u32 = 0x9E37_79B1;

/// Hash table that counts and numbers the colours of a picture. It is faster than the hash table of the standard library, which resists
/// collision attacks.
struct Colours {
    /// Number of the colour in each slot, from 1; 0 for an empty slot.
    slots: Vec<u16>,
    /// Colours, each with the number of its runs of pixels.
    found: Vec<(Word, u32)>,
}

impl Indexed {
    /// Creates an indexed image from `count` pixels. Up to 256 colours are kept exactly; otherwise similar colours are merged, the most
    /// frequent first. Returns `None` if too many colours remain.
    pub(crate) fn new(count: usize, pixels: impl Iterator<Item = Word> + Clone) -> Option<Self> {
        if let Some((colours, pixels)) = Colours::number::<u8>(count, pixels.clone()) {
            let palette = colours.found.iter().map(|(colour, _)| rgb(*colour)).collect();
            return Some(Self { palette, pixels });
        }
        let (colours, numbered) = Colours::number::<u16>(count, pixels)?;
        let (palette, places) = colours.palette()?;
        let pixels = numbered.into_iter().map(|number| places[usize::from(number)]).collect();
        Some(Self { palette, pixels })
    }
}

impl Colours {
    /// Numbers the colours in order of appearance. Returns `None` if there are more than the table or the number type allows.
    fn number<N: Copy + Default + TryFrom<u16>>(
        count: usize,
        pixels: impl Iterator<Item = Word>,
    ) -> Option<(Self, Vec<N>)> {
        let mut colours = Self { slots: vec![0; SLOTS], found: Vec::new() };
        let mut numbered = vec![N::default(); count];
        let (mut last, mut number) = (None, N::default());
        for (pixel, colour) in numbered.iter_mut().zip(pixels) {
            // Most pixels equal the previous one.
            if last != Some(colour) {
                (last, number) = (Some(colour), N::try_from(colours.take(colour)?).ok()?);
            }
            *pixel = number;
        }
        Some((colours, numbered))
    }

    fn take(&mut self, colour: Word) -> Option<u16> {
        let mut slot = (colour.wrapping_mul(SPREAD) >> 18) as usize;
        while self.slots[slot] > 0 {
            let number = self.slots[slot] - 1;
            let found = &mut self.found[usize::from(number)];
            if found.0 == colour {
                found.1 += 1;
                return Some(number);
            }
            slot = (slot + 1) % SLOTS;
        }
        let number =
            u16::try_from(self.found.len()).ok().filter(|number| usize::from(*number) < SLOTS / 2)?;
        self.slots[slot] = number + 1;
        self.found.push((colour, 1));
        Some(number)
    }

    /// Returns the palette, and the palette index of each colour.
    fn palette(&self) -> Option<(Vec<Rgb>, Vec<u8>)> {
        let mut order: Vec<usize> = (0..self.found.len()).collect();
        order.sort_by_key(|&number| (std::cmp::Reverse(self.found[number].1), self.found[number].0));
        NEAR.into_iter().find_map(|near| self.merged(&order, near))
    }

    /// Returns the palette in which each colour is merged with the nearest earlier one if they differ by at most `near`. `None` if more
    /// than 256 colours remain.
    fn merged(&self, order: &[usize], near: u8) -> Option<(Vec<Rgb>, Vec<u8>)> {
        let mut palette: Vec<Rgb> = Vec::new();
        let mut places = vec![0; self.found.len()];
        for &number in order {
            let colour = rgb(self.found[number].0);
            let far = |other: &Rgb| (0..3).map(|i| other[i].abs_diff(colour[i])).max().unwrap_or(0);
            let nearest = palette.iter().enumerate().min_by_key(|(_, other)| far(other));
            let place = match nearest {
                Some((place, other)) if far(other) <= near => place,
                _ if palette.len() == MOST => return None,
                _ => {
                    palette.push(colour);
                    palette.len() - 1
                }
            };
            places[number] = place as u8;
        }
        Some((palette, places))
    }
}

/// Converts a colour to an integer.
pub(crate) fn word([r, g, b]: Rgb) -> Word {
    u32::from_le_bytes([r, g, b, 255])
}

fn rgb(colour: Word) -> Rgb {
    let [r, g, b, _] = colour.to_le_bytes();
    [r, g, b]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn indexed(pixels: &[Rgb]) -> Option<Indexed> {
        Indexed::new(pixels.len(), pixels.iter().copied().map(word))
    }

    fn colours(indexed: &Indexed) -> Vec<Rgb> {
        indexed.pixels.iter().map(|&place| indexed.palette[usize::from(place)]).collect()
    }

    #[test]
    fn as_many_colours_as_a_palette_has_stay_as_they_are() {
        // 256 similar greys, which are merged only if there is one more colour.
        let greys: Vec<Rgb> = (0..=255).map(|grey| [grey; 3]).collect();
        let drawn = indexed(&greys).unwrap();
        assert_eq!((drawn.palette.len(), colours(&drawn)), (256, greys.clone()));
        let more = [greys, vec![[255, 0, 0]]].concat();
        let drawn = indexed(&more).unwrap();
        assert!(drawn.palette.len() < 256 && colours(&drawn)[256] == [255, 0, 0]);
    }

    #[test]
    fn what_has_too_many_colours_is_not_indexed() {
        let all = (0..=u8::MAX).step_by(16).flat_map(|r| (0..=u8::MAX).step_by(13).map(move |g| [r, g, 0]));
        assert!(indexed(&all.collect::<Vec<Rgb>>()).is_none());
    }

    proptest! {
        /// No pixel differs from its colour by more than the largest step.
        #[test]
        fn colours_stay_near(
            pixels in proptest::collection::vec((0..40_u8, 100..160_u8, 0..2_u8), 1..3000)
        ) {
            let pixels: Vec<Rgb> = pixels.into_iter().map(|(r, g, b)| [r, g, b]).collect();
            let Some(drawn) = indexed(&pixels) else { return Ok(()) };
            for (want, got) in pixels.iter().zip(colours(&drawn)) {
                prop_assert!((0..3).all(|i| want[i].abs_diff(got[i]) <= NEAR[3]), "{want:?} {got:?}");
            }
        }
    }
}
