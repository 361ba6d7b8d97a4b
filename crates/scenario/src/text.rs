//! Files as text: read up to a limit, told to be UTF-8 or not.

use std::fs::File;
use std::io::{self, Read};
use std::ops::Range;
use std::path::Path;

/// Bytes that are no UTF-8 text.
#[derive(Debug, PartialEq)]
pub(crate) struct Garbled {
    /// The text as far as it can be shown.
    pub(crate) text: String,
    /// What is no text in it.
    pub(crate) range: Range<usize>,
    pub(crate) message: String,
    pub(crate) help: String,
}

/// The bytes of a file; none where there are more than `limit`.
pub(crate) fn read(path: &Path, limit: usize) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(limit as u64 + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() <= limit).then_some(bytes))
}

/// The text that bytes are, without the mark of byte order that some editors put before it.
pub(crate) fn decode(bytes: Vec<u8>) -> Result<String, Garbled> {
    if let Some(text) = utf_16(&bytes) {
        let message = "expected UTF-8 text, got UTF-16".to_owned();
        return Err(Garbled { text, range: 0..1, message, help: "save the file as UTF-8".to_owned() });
    }
    match String::from_utf8(bytes) {
        Ok(text) => Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text)),
        Err(error) => {
            let start = error.utf8_error().valid_up_to();
            let byte = error.as_bytes()[start];
            let help = match byte {
                0xa0.. => format!("save the file as UTF-8; as Latin-1 the byte is \"{}\"", char::from(byte)),
                _ => "save the file as UTF-8".to_owned(),
            };
            Err(Garbled {
                text: String::from_utf8_lossy(error.as_bytes()).into_owned(),
                range: start..start + '\u{fffd}'.len_utf8(),
                message: format!("expected UTF-8 text, got the byte 0x{byte:02X}"),
                help,
            })
        }
    }
}

/// UTF-16 with its mark of byte order, as some editors write it.
fn utf_16(bytes: &[u8]) -> Option<String> {
    let unit: fn([u8; 2]) -> u16 = match bytes.get(..2)? {
        [0xff, 0xfe] => u16::from_le_bytes,
        [0xfe, 0xff] => u16::from_be_bytes,
        _ => return None,
    };
    let (units, _) = bytes[2..].as_chunks::<2>();
    let units: Vec<u16> = units.iter().copied().map(unit).collect();
    Some(String::from_utf16_lossy(&units))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_text_has_a_place() {
        assert_eq!(decode("\u{feff}ä".into()), Ok("ä".to_owned()));
        let garbled = decode(b"ab\xe4c".to_vec()).unwrap_err();
        assert_eq!((garbled.text.as_str(), garbled.range), ("ab\u{fffd}c", 2..5));
        assert!(garbled.help.ends_with("\"ä\""));
        for (mark, unit) in
            [([0xff, 0xfe], u16::to_le_bytes as fn(u16) -> [u8; 2]), ([0xfe, 0xff], u16::to_be_bytes)]
        {
            let bytes: Vec<u8> = mark.into_iter().chain("{ä".encode_utf16().flat_map(unit)).collect();
            let garbled = decode(bytes).unwrap_err();
            assert_eq!((garbled.text.as_str(), garbled.message.ends_with("UTF-16")), ("{ä", true));
        }
    }
}
