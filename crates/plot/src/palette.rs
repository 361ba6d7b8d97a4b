//! Pictures of few colours: a byte for every pixel instead of three.
//!
//! Line art has few colours: inks, and what smoothing leaves between two of them. A third of the bytes is compressed in a
//! tenth of the work.

/// Red, green, blue.
pub(crate) type Rgb = [u8; 3];

/// A colour in one word, red lowest; the highest byte is the same for all pixels of a picture.
pub(crate) type Word = u32;

/// Most colours of a palette.
const MOST: usize = 256;
/// How far a colour may be from what stands for it, per channel: where several smoothed lines cross, a few pixels have
/// mixtures of their own, which nobody tells from their neighbours.
const NEAR: [u8; 4] = [1, 2, 4, 6];

/// A picture with a table of its colours.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Indexed {
    /// The colours, at most 256.
    pub(crate) palette: Vec<Rgb>,
    /// The place of every pixel's colour in the palette, row by row.
    pub(crate) pixels: Vec<u8>,
}

/// Slots of the table of colours, a power of two; more than half as many colours are too many for a palette.
const SLOTS: usize = 1 << 14;
/// An odd number near 2³² over the golden ratio (Knuth, The Art of Computer Programming 3, 6.4): spreads colours over the slots.
const SPREAD: u32 = 0x9E37_79B1;

/// Counts and numbers the colours of a picture. The table is our own: the library's, safe against made-up keys, took as long as
/// all painting.
struct Colours {
    /// The number of the colour in each slot, from 1; 0 where there is none.
    slots: Vec<u16>,
    /// Every colour with the number of runs of pixels that it has.
    found: Vec<(Word, u32)>,
}

impl Indexed {
    /// Of so many pixels of a picture. Up to 256 colours are kept as they are; of more, near ones become one, most frequent
    /// first. None where that does not do.
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
    /// The number of every pixel's colour, in order of appearance; none of more colours than the numbers tell apart.
    fn number<N: Copy + Default + TryFrom<u16>>(
        count: usize,
        pixels: impl Iterator<Item = Word>,
    ) -> Option<(Self, Vec<N>)> {
        let mut colours = Self { slots: vec![0; SLOTS], found: Vec::new() };
        let mut numbered = vec![N::default(); count];
        let (mut last, mut number) = (None, N::default());
        for (pixel, colour) in numbered.iter_mut().zip(pixels) {
            // Most pixels are like the one before.
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

    /// A palette, and for every colour its place there.
    fn palette(&self) -> Option<(Vec<Rgb>, Vec<u8>)> {
        let mut order: Vec<usize> = (0..self.found.len()).collect();
        order.sort_by_key(|&number| (std::cmp::Reverse(self.found[number].1), self.found[number].0));
        NEAR.into_iter().find_map(|near| self.merged(&order, near))
    }

    /// The same with colours no farther than `near` from one before them in its place.
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

/// A colour as one word.
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
        // Neighbours in grey, which would be merged if there were one more.
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
        /// No pixel is farther from its colour than the last of the steps.
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
