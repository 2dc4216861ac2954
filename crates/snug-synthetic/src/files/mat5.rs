//! MAT files of level 5, written byte for byte the same every time: no date stands in them.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::{self, Write};

const MI_INT8: u32 = 1;
const MI_UINT16: u32 = 4;
const MI_INT32: u32 = 5;
const MI_UINT32: u32 = 6;
const MI_SINGLE: u32 = 7;
const MI_DOUBLE: u32 = 9;
const MI_MATRIX: u32 = 14;
const MI_COMPRESSED: u32 = 15;

const MX_CELL: u32 = 1;
const MX_CHAR: u32 = 4;
const MX_DOUBLE: u32 = 6;
const MX_SINGLE: u32 = 7;

/// What the 116 bytes of text at the file's start say; `MATLAB 5.0` is how readers know the format.
const HEADER_TEXT: &str = "MATLAB 5.0 MAT-file, simulated by snug-synthetic";

/// What a variable holds.
#[derive(Debug, Clone, PartialEq)]
pub enum MatValue<'a> {
    /// A row of characters.
    Text(&'a str),
    /// A cell array of texts, row by row.
    CellOfText {
        /// Number of columns.
        columns: usize,
        /// The texts, one row after the other.
        texts: Vec<String>,
    },
    /// A column of single-precision numbers.
    Single(&'a [f64]),
    /// A column of double-precision numbers.
    Double(&'a [f64]),
}

/// A MAT file of level 5, little-endian, of `(name, value)` pairs.
///
/// With `compressed` every variable is a zlib stream of its own, as MATLAB writes by default.
///
/// # Errors
/// Never in practice: the compressor writes to memory.
pub fn mat5(variables: &[(&str, MatValue)], compressed: bool) -> io::Result<Vec<u8>> {
    let mut file = header();
    for (name, value) in variables {
        let element = matrix(name, value);
        if compressed {
            let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
            encoder.write_all(&element)?;
            let packed = encoder.finish()?;
            // A compressed element is the only one that is not padded.
            file.extend(MI_COMPRESSED.to_le_bytes());
            file.extend(size(packed.len()));
            file.extend(packed);
        } else {
            file.extend(element);
        }
    }
    Ok(file)
}

fn header() -> Vec<u8> {
    let mut header = HEADER_TEXT.as_bytes().to_vec();
    header.resize(116, b' ');
    header.extend([0; 8]);
    header.extend(0x0100_u16.to_le_bytes());
    header.extend(b"IM");
    header
}

fn matrix(name: &str, value: &MatValue) -> Vec<u8> {
    let (class, rows, columns) = match value {
        MatValue::Text(text) => (MX_CHAR, 1, text.encode_utf16().count()),
        MatValue::CellOfText { columns, texts } => (MX_CELL, texts.len() / columns, *columns),
        MatValue::Single(samples) => (MX_SINGLE, samples.len(), 1),
        MatValue::Double(samples) => (MX_DOUBLE, samples.len(), 1),
    };
    let mut body = Vec::new();
    put(&mut body, MI_UINT32, &words([class, 0]));
    put(&mut body, MI_INT32, &words([rows as u32, columns as u32]));
    put(&mut body, MI_INT8, name.as_bytes());
    match value {
        MatValue::Text(text) => {
            let units: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
            put(&mut body, MI_UINT16, &units);
        }
        MatValue::CellOfText { columns, texts } => {
            // MATLAB stores column by column.
            for column in 0..*columns {
                for text in texts.iter().skip(column).step_by(*columns) {
                    body.extend(matrix("", &MatValue::Text(text)));
                }
            }
        }
        MatValue::Single(samples) => {
            let bytes: Vec<u8> = samples
                .iter()
                .flat_map(|sample| (*sample as f32).to_le_bytes())
                .collect();
            put(&mut body, MI_SINGLE, &bytes);
        }
        MatValue::Double(samples) => {
            let bytes: Vec<u8> = samples.iter().flat_map(|s| s.to_le_bytes()).collect();
            put(&mut body, MI_DOUBLE, &bytes);
        }
    }
    let mut element = Vec::with_capacity(body.len() + 8);
    element.extend(MI_MATRIX.to_le_bytes());
    element.extend(size(body.len()));
    element.extend(body);
    element
}

/// One data element: tag, bytes, padding to eight; up to four bytes stand within the tag.
fn put(body: &mut Vec<u8>, kind: u32, data: &[u8]) {
    if (1..=4).contains(&data.len()) {
        body.extend((kind | (data.len() as u32) << 16).to_le_bytes());
        body.extend(data);
        body.resize(body.len() + 4 - data.len(), 0);
    } else {
        body.extend(kind.to_le_bytes());
        body.extend(size(data.len()));
        body.extend(data);
        body.resize(body.len().next_multiple_of(8), 0);
    }
}

fn words(words: [u32; 2]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

fn size(bytes: usize) -> [u8; 4] {
    u32::try_from(bytes)
        .expect("level 5 holds elements below 4 GiB, and a simulated file is a few megabytes")
        .to_le_bytes()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::io::Read;

    /// Facts of the format's public description, byte for byte.
    #[test]
    fn a_small_file_is_what_the_format_says() {
        let file = mat5(&[("ab", MatValue::Single(&[1.0, -2.0, 0.5]))], false).unwrap();
        assert!(file.starts_with(b"MATLAB 5.0 MAT-file"));
        assert_eq!(file[116..124], [0; 8]);
        assert_eq!(file[124..128], [0x00, 0x01, b'I', b'M']);
        let expected = [
            [14, 0, 0, 0, 64, 0, 0, 0],     // miMATRIX, 64 bytes follow
            [6, 0, 0, 0, 8, 0, 0, 0],       // array flags
            [7, 0, 0, 0, 0, 0, 0, 0],       // mxSINGLE_CLASS
            [5, 0, 0, 0, 8, 0, 0, 0],       // dimensions
            [3, 0, 0, 0, 1, 0, 0, 0],       // 3 × 1
            [1, 0, 2, 0, b'a', b'b', 0, 0], // name, small element
            [7, 0, 0, 0, 12, 0, 0, 0],      // three singles
            [0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0],
            [0, 0, 0, 0x3f, 0, 0, 0, 0], // padding
        ];
        assert_eq!(file[128..], expected.concat()[..]);
    }

    #[test]
    fn a_compressed_variable_is_the_plain_one_in_a_zlib_stream() {
        let variables = [("File_name", MatValue::Text("TP1_QS_Soft_5"))];
        let plain = mat5(&variables, false).unwrap();
        let packed = mat5(&variables, true).unwrap();
        assert_eq!(packed[128..132], [15, 0, 0, 0]);
        let length = u32::from_le_bytes(packed[132..136].try_into().unwrap()) as usize;
        assert_eq!(packed.len(), 136 + length);
        let mut inflated = Vec::new();
        flate2::read::ZlibDecoder::new(&packed[136..])
            .read_to_end(&mut inflated)
            .unwrap();
        assert_eq!(inflated, plain[128..]);
    }

    #[test]
    fn a_cell_holds_its_texts_column_by_column() {
        let texts = ["a", "b", "c", "d", "e", "f"].map(String::from).to_vec();
        let cell = MatValue::CellOfText { columns: 3, texts };
        let file = mat5(&[("Events", cell)], false).unwrap();
        let letters: Vec<u8> = file[128..]
            .windows(5)
            .filter(|bytes| bytes[..4] == [4, 0, 2, 0])
            .map(|bytes| bytes[4])
            .collect();
        assert_eq!(letters, b"adbecf");
    }
}
