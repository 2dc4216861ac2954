//! MAT files of level 5, put together element by element.
#![allow(dead_code, reason = "every test takes what it needs")]

use std::io::Write as _;

/// A whole file.
pub fn file(elements: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = vec![b' '; 124];
    bytes.extend(b"\x00\x01IM");
    bytes.extend(elements.concat());
    bytes
}

/// A tag, the data and their padding.
pub fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes = tag(kind, data.len());
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

fn tag(kind: u32, size: usize) -> Vec<u8> {
    [kind, u32::try_from(size).expect("below 4 GB")]
        .map(u32::to_le_bytes)
        .concat()
}

/// What stands in an array before its elements: flags with the class, shape, name.
pub fn start(class: u32, dims: &[u32], name: &str) -> Vec<u8> {
    let words = |words: &[u32]| -> Vec<u8> { words.iter().flat_map(|w| w.to_le_bytes()).collect() };
    let mut data = element(6, &words(&[class, 0]));
    data.extend(element(5, &words(dims)));
    data.extend(element(1, name.as_bytes()));
    data
}

/// An array with its elements.
pub fn array(class: u32, dims: &[u32], name: &str, parts: &[Vec<u8>]) -> Vec<u8> {
    let mut data = start(class, dims, name);
    data.extend(parts.concat());
    element(14, &data)
}

/// A column of doubles.
pub fn doubles(name: &str, values: &[f64]) -> Vec<u8> {
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    array(6, &[values.len() as u32, 1], name, &[element(9, &bytes)])
}

/// A row of characters.
pub fn text(name: &str, text: &str) -> Vec<u8> {
    array(
        4,
        &[1, text.len() as u32],
        name,
        &[element(16, text.as_bytes())],
    )
}

/// An element, compressed.
pub fn deflated(element: &[u8]) -> Vec<u8> {
    compressed(|encoder| encoder.write_all(element).expect("memory takes all"))
}

/// An array whose data end in `count` times `piece`, compressed without ever being in memory.
pub fn bomb(mut start: Vec<u8>, last: Option<u32>, piece: &[u8], count: usize) -> Vec<u8> {
    let size = piece.len() * count;
    if let Some(kind) = last {
        start.extend(tag(kind, size));
    }
    compressed(|encoder| {
        encoder
            .write_all(&tag(14, start.len() + size))
            .expect("memory takes all");
        encoder.write_all(&start).expect("memory takes all");
        for _ in 0..count {
            encoder.write_all(piece).expect("memory takes all");
        }
    })
}

fn compressed(write: impl FnOnce(&mut flate2::write::ZlibEncoder<Vec<u8>>)) -> Vec<u8> {
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    write(&mut encoder);
    let data = encoder.finish().expect("memory takes all");
    let mut bytes = tag(15, data.len());
    bytes.extend(data);
    bytes
}
