//! MATLAB wrote its first 7.3 files (2006 to 2008) with HDF5 1.6, whose data-layout messages have version 1 or 2. The
//! HDF5 library reads version 3 and later. The same content in version 3 is shorter, so it is put in the old one's place.
//!
//! Source: *HDF5 File Format Specification*, section IV.A.2.i, "Data Layout Message".

/// Header of a message in a version 1 object header: type (2 bytes), size (2), flags (1), reserved (3).
const MESSAGE_HEADER: usize = 8;
/// Version, dimensionality, class, reserved (5).
const OLD_HEADER: usize = 8;
const ADDRESS: usize = 8;
const MOST_DIMENSIONS: u8 = 33;
const CONTIGUOUS: u8 = 1;
const CHUNKED: u8 = 2;

/// Rewrites every layout message of version 1 or 2 as version 3; returns whether there was any.
pub(super) fn modernise(bytes: &mut [u8]) -> bool {
    let mut found = false;
    // Messages are aligned to 8 bytes. Fourteen bytes with fixed or narrow values make a mistake as good as impossible.
    for start in (0..bytes.len()).step_by(8) {
        if let Some(message) = new_message(&bytes[start..]) {
            bytes[start + MESSAGE_HEADER..][..message.len()].copy_from_slice(&message);
            found = true;
        }
    }
    found
}

fn new_message(bytes: &[u8]) -> Option<Vec<u8>> {
    let (header, rest) = bytes.split_first_chunk::<MESSAGE_HEADER>()?;
    let &[8, 0, size_low, size_high, _, 0, 0, 0] = header else {
        return None;
    };
    let body = rest.get(..usize::from(u16::from_le_bytes([size_low, size_high])))?;
    let &[
        1 | 2,
        dimensions @ 1..=MOST_DIMENSIONS,
        class,
        0,
        0,
        0,
        0,
        0,
    ] = body.first_chunk::<OLD_HEADER>()?
    else {
        return None;
    };
    let address = body.get(OLD_HEADER..OLD_HEADER + ADDRESS)?;
    let lengths = body
        .get(OLD_HEADER + ADDRESS..)?
        .get(..4 * usize::from(dimensions))?;
    let mut message = match class {
        CONTIGUOUS => vec![3, CONTIGUOUS],
        CHUNKED => vec![3, CHUNKED, dimensions],
        _ => return None,
    };
    message.extend_from_slice(address);
    if class == CHUNKED {
        message.extend_from_slice(lengths);
    } else {
        let (lengths, _) = lengths.as_chunks::<4>();
        let size = lengths.iter().try_fold(1_u64, |size, &length| {
            size.checked_mul(u64::from(u32::from_le_bytes(length)))
        })?;
        message.extend_from_slice(&size.to_le_bytes());
    }
    message.resize(body.len(), 0);
    Some(message)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A message as HDF5 1.6 writes it for 9×1 doubles at 0x0e00, cut from MATLAB 7.4's output.
    const CONTIGUOUS_9: [u8; 40] = [
        8, 0, 32, 0, 1, 0, 0, 0, 2, 3, 1, 0, 0, 0, 0, 0, 0, 0x0e, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0, 1,
        0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0,
    ];

    #[test]
    fn contiguous_layout_keeps_address_and_size() {
        let mut bytes = vec![0; 16];
        bytes.extend(CONTIGUOUS_9);
        assert!(modernise(&mut bytes));
        assert_eq!(bytes[16..24], CONTIGUOUS_9[..8], "the message header stays");
        assert_eq!(bytes[24..26], [3, 1]);
        assert_eq!(bytes[26..34], 0x0e00_u64.to_le_bytes());
        assert_eq!(bytes[34..42], 72_u64.to_le_bytes());
        assert!(!modernise(&mut bytes), "nothing is left to do");
    }

    #[test]
    fn chunked_layout_keeps_its_lengths() {
        let mut bytes = CONTIGUOUS_9;
        bytes[10] = 2;
        assert!(modernise(&mut bytes));
        assert_eq!(bytes[8..11], [3, 2, 3]);
        assert_eq!(bytes[11..19], 0x0e00_u64.to_le_bytes());
        assert_eq!(bytes[19..31], [9, 0, 0, 0, 1, 0, 0, 0, 8, 0, 0, 0]);
    }
}
