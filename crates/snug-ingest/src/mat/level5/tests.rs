//! What the collected files do not show, put together byte by byte from the format's description.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::mat::{Content, MatFile, Numbers, Unsupported, Value};
use std::io::Write as _;

fn element(kind: u32, data: &[u8], order: ByteOrder) -> Vec<u8> {
    let mut bytes = [kind, u32::try_from(data.len()).unwrap()]
        .map(|number| put(number, order))
        .concat();
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

fn put(number: u32, order: ByteOrder) -> [u8; 4] {
    match order {
        ByteOrder::Little => number.to_le_bytes(),
        ByteOrder::Big => number.to_be_bytes(),
    }
}

fn words(numbers: &[u32], order: ByteOrder) -> Vec<u8> {
    numbers
        .iter()
        .flat_map(|&number| put(number, order))
        .collect()
}

/// An array element: flags, shape, name, and the parts that follow.
fn array(class: u32, dims: &[u32], name: &str, parts: &[Vec<u8>], order: ByteOrder) -> Vec<u8> {
    let mut data = element(6, &words(&[class, 0], order), order);
    data.extend(element(5, &words(dims, order), order));
    data.extend(element(1, name.as_bytes(), order));
    data.extend(parts.concat());
    element(14, &data, order)
}

fn file(elements: &[Vec<u8>], order: ByteOrder) -> Vec<u8> {
    let mut bytes = vec![b' '; 124];
    bytes.extend(match order {
        ByteOrder::Little => *b"\x00\x01IM",
        ByteOrder::Big => *b"\x01\x00MI",
    });
    bytes.extend(elements.concat());
    bytes
}

fn read(elements: &[Vec<u8>], order: ByteOrder) -> Result<Vec<Value>, IngestError> {
    let read = MatFile::from_bytes(file(elements, order))?;
    Ok(read
        .variables
        .into_iter()
        .map(|variable| variable.value)
        .collect())
}

const BOTH: [ByteOrder; 2] = [ByteOrder::Little, ByteOrder::Big];

#[test]
fn opaque_objects_and_function_handles_are_said_to_be_unsupported() {
    for order in BOTH {
        let mut opaque = element(6, &words(&[17, 0], order), order);
        for name in ["when", "MCOS", "datetime"] {
            opaque.extend(element(1, name.as_bytes(), order));
        }
        opaque.extend(array(
            13,
            &[2, 1],
            "",
            &[element(6, &words(&[1, 2], order), order)],
            order,
        ));
        let handle = array(
            16,
            &[1, 1],
            "f",
            &[array(2, &[1, 1], "", &[], order)],
            order,
        );
        let number = array(6, &[1, 1], "x", &[element(2, &[7], order)], order);
        let workspace = array(9, &[1, 3], "", &[element(2, &[1, 2, 3], order)], order);
        let elements = [element(14, &opaque, order), handle, number, workspace];
        let values = read(&elements, order).unwrap();
        assert_eq!(values.len(), 3, "the nameless workspace is no variable");
        let class_name = "datetime".to_owned();
        assert_eq!(
            values[0].content,
            Content::Unsupported(Unsupported::Opaque { class_name })
        );
        assert_eq!(
            values[1].content,
            Content::Unsupported(Unsupported::FunctionHandle)
        );
        assert_eq!(values[2].to_f64().unwrap(), [7.0]);
    }
}

#[test]
fn text_in_every_encoding() {
    let order = ByteOrder::Big;
    let utf16: Vec<u8> = "aµ😀".encode_utf16().flat_map(u16::to_be_bytes).collect();
    for (kind, units, bytes, text) in [
        (16, 3, "aµ≥".as_bytes().to_vec(), "aµ≥"),
        (17, 4, utf16.clone(), "aµ😀"),
        (4, 4, utf16, "aµ😀"),
        (18, 2, words(&[0x61, 0x1F600], order), "a😀"),
        (2, 2, vec![0x61, 0xB5], "aµ"),
    ] {
        let values = read(
            &[array(
                4,
                &[1, units],
                "t",
                &[element(kind, &bytes, order)],
                order,
            )],
            order,
        )
        .unwrap();
        assert_eq!(values[0].text().unwrap(), text, "element type {kind}");
    }
    let short = array(4, &[1, 5], "t", &[element(16, b"ab", order)], order);
    assert!(matches!(
        read(&[short], order),
        Err(IngestError::ValueCount { .. })
    ));
}

#[test]
fn wide_integers_and_empty_structs() {
    for order in BOTH {
        let wide = match order {
            ByteOrder::Little => u64::MAX.to_le_bytes(),
            ByteOrder::Big => u64::MAX.to_be_bytes(),
        };
        let no_fields = [
            element(5, &words(&[0], order), order),
            element(1, &[], order),
        ];
        let values = read(
            &[
                array(15, &[1, 1], "u", &[element(13, &wide, order)], order),
                array(2, &[1, 1], "s", &no_fields, order),
            ],
            order,
        )
        .unwrap();
        let Content::Numeric { real, .. } = &values[0].content else {
            panic!("{:?}", values[0]);
        };
        assert_eq!(*real, Numbers::U64(vec![u64::MAX]));
        assert!(matches!(&values[1].content, Content::Struct { fields, .. } if fields.is_empty()));
    }
}

#[test]
fn claims_that_the_file_cannot_hold_are_refused() {
    let order = ByteOrder::Little;
    let huge = [0x7FFF_FFFF, 0x7FFF_FFFF];
    let one_field = [
        element(5, &words(&[2], order), order),
        element(1, b"a\0", order),
    ];
    for (class, parts) in [
        (1, vec![]),
        (2, one_field.to_vec()),
        (6, vec![element(9, &[0; 8], order)]),
    ] {
        assert!(
            read(&[array(class, &huge, "x", &parts, order)], order).is_err(),
            "class {class}"
        );
    }
    let four_dims = [0x7FFF_FFFF; 4];
    assert!(matches!(
        read(&[array(1, &four_dims, "x", &[], order)], order),
        Err(IngestError::TooManyElements { .. })
    ));
    // Cells within cells within cells.
    let mut nested = array(6, &[1, 1], "", &[element(2, &[7], order)], order);
    for depth in 0..150 {
        nested = array(
            1,
            &[1, 1],
            if depth == 149 { "x" } else { "" },
            &[nested],
            order,
        );
    }
    assert!(matches!(
        read(&[nested], order),
        Err(IngestError::NestedTooDeep { .. })
    ));
}

/// A double array of a million zeros in a few kilobytes, which announces another length.
fn deflated(announced: u32) -> Vec<u8> {
    let order = ByteOrder::Little;
    let mut bytes = array(
        6,
        &[1, 1 << 20],
        "x",
        &[element(9, &vec![0; 8 << 20], order)],
        order,
    );
    bytes[4..8].copy_from_slice(&put(announced, order));
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(&bytes).unwrap();
    let deflated = encoder.finish().unwrap();
    let mut bytes = words(&[15, u32::try_from(deflated.len()).unwrap()], order);
    bytes.extend(deflated);
    bytes
}

#[test]
fn more_than_announced_is_not_inflated() {
    for announced in [80, 4000, 1 << 19, u32::MAX] {
        let error = read(&[deflated(announced)], ByteOrder::Little).unwrap_err();
        let IngestError::InCompressed { source, .. } = error else {
            panic!("{error}");
        };
        assert!(
            matches!(*source, IngestError::Inflate { inflated, .. } if inflated < 1 << 20),
            "{announced}: {source}"
        );
    }
}
