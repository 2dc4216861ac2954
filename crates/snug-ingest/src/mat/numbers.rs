//! Numeric arrays in the type of their MATLAB class, so that 64-bit integers stay exact until doubles are asked for.

use super::cursor::ByteOrder;

/// The numbers of an array, in column-major order, as the file's class holds them.
#[derive(Debug, Clone, PartialEq)]
pub enum Numbers {
    /// `double`
    F64(Vec<f64>),
    /// `single`
    F32(Vec<f32>),
    /// `int8`
    I8(Vec<i8>),
    /// `uint8`
    U8(Vec<u8>),
    /// `int16`
    I16(Vec<i16>),
    /// `uint16`
    U16(Vec<u16>),
    /// `int32`
    I32(Vec<i32>),
    /// `uint32`
    U32(Vec<u32>),
    /// `int64`
    I64(Vec<i64>),
    /// `uint64`
    U64(Vec<u64>),
}

/// The kinds of number a file stores, in the order of MATLAB's numeric classes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NumberKind {
    F64,
    F32,
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
}

impl NumberKind {
    /// MATLAB's classes, in their order.
    pub(crate) const CLASSES: [(Self, &str); 10] = [
        (Self::F64, "double"),
        (Self::F32, "single"),
        (Self::I8, "int8"),
        (Self::U8, "uint8"),
        (Self::I16, "int16"),
        (Self::U16, "uint16"),
        (Self::I32, "int32"),
        (Self::U32, "uint32"),
        (Self::I64, "int64"),
        (Self::U64, "uint64"),
    ];

    pub(crate) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::F32 | Self::I32 | Self::U32 => 4,
            Self::F64 | Self::I64 | Self::U64 => 8,
        }
    }
}

/// Runs `$body` with `$values` bound to whichever vector is inside.
macro_rules! each_kind {
    ($numbers:expr, $values:ident => $body:expr) => {
        match $numbers {
            Numbers::F64($values) => $body,
            Numbers::F32($values) => $body,
            Numbers::I8($values) => $body,
            Numbers::U8($values) => $body,
            Numbers::I16($values) => $body,
            Numbers::U16($values) => $body,
            Numbers::I32($values) => $body,
            Numbers::U32($values) => $body,
            Numbers::I64($values) => $body,
            Numbers::U64($values) => $body,
        }
    };
}

/// Decodes numbers of one primitive type.
macro_rules! decode {
    ($kind:ident, $primitive:ty, $bytes:expr, $order:expr) => {
        Numbers::$kind(
            $bytes
                .as_chunks::<{ size_of::<$primitive>() }>()
                .0
                .iter()
                .map(|&chunk| match $order {
                    ByteOrder::Little => <$primitive>::from_le_bytes(chunk),
                    ByteOrder::Big => <$primitive>::from_be_bytes(chunk),
                })
                .collect(),
        )
    };
}

impl Numbers {
    pub(crate) fn kind(&self) -> NumberKind {
        match self {
            Self::F64(_) => NumberKind::F64,
            Self::F32(_) => NumberKind::F32,
            Self::I8(_) => NumberKind::I8,
            Self::U8(_) => NumberKind::U8,
            Self::I16(_) => NumberKind::I16,
            Self::U16(_) => NumberKind::U16,
            Self::I32(_) => NumberKind::I32,
            Self::U32(_) => NumberKind::U32,
            Self::I64(_) => NumberKind::I64,
            Self::U64(_) => NumberKind::U64,
        }
    }

    /// How many bytes the values take.
    pub(crate) fn bytes(&self) -> u64 {
        each_kind!(self, values => size_of_val(values.as_slice()) as u64)
    }

    /// Decodes as many whole numbers as `bytes` holds.
    pub(crate) fn decode(kind: NumberKind, bytes: &[u8], order: ByteOrder) -> Self {
        match kind {
            NumberKind::F64 => decode!(F64, f64, bytes, order),
            NumberKind::F32 => decode!(F32, f32, bytes, order),
            NumberKind::I8 => decode!(I8, i8, bytes, order),
            NumberKind::U8 => decode!(U8, u8, bytes, order),
            NumberKind::I16 => decode!(I16, i16, bytes, order),
            NumberKind::U16 => decode!(U16, u16, bytes, order),
            NumberKind::I32 => decode!(I32, i32, bytes, order),
            NumberKind::U32 => decode!(U32, u32, bytes, order),
            NumberKind::I64 => decode!(I64, i64, bytes, order),
            NumberKind::U64 => decode!(U64, u64, bytes, order),
        }
    }

    /// How many.
    pub fn len(&self) -> usize {
        each_kind!(self, values => values.len())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All as doubles; 64-bit integers beyond 2⁵³ are rounded.
    #[expect(
        clippy::unnecessary_cast,
        reason = "one line for all kinds, double among them"
    )]
    pub fn to_f64(&self) -> Vec<f64> {
        each_kind!(self, values => values.iter().map(|&value| value as f64).collect())
    }

    /// All as doubles, as [`Numbers::to_f64`]; doubles stay where they are.
    pub fn into_f64(self) -> Vec<f64> {
        match self {
            Self::F64(values) => values,
            others => others.to_f64(),
        }
    }

    /// The same values as another kind. Files store a class in a narrower kind only where that loses nothing.
    pub(crate) fn into_kind(self, kind: NumberKind) -> Self {
        macro_rules! cast {
            ($target:ident, $primitive:ty) => {
                if let Self::$target(values) = self {
                    Self::$target(values)
                } else {
                    Self::$target(
                        each_kind!(self, values => values.iter().map(|&value| value as $primitive).collect()),
                    )
                }
            };
        }
        match kind {
            NumberKind::F64 => cast!(F64, f64),
            NumberKind::F32 => cast!(F32, f32),
            NumberKind::I8 => cast!(I8, i8),
            NumberKind::U8 => cast!(U8, u8),
            NumberKind::I16 => cast!(I16, i16),
            NumberKind::U16 => cast!(U16, u16),
            NumberKind::I32 => cast!(I32, i32),
            NumberKind::U32 => cast!(U32, u32),
            NumberKind::I64 => cast!(I64, i64),
            NumberKind::U64 => cast!(U64, u64),
        }
    }

    /// Each number as "is not zero".
    #[expect(
        clippy::unnecessary_cast,
        reason = "one line for all kinds, double among them"
    )]
    pub(crate) fn to_logical(&self) -> Vec<bool> {
        each_kind!(self, values => values.iter().map(|&value| value as f64 != 0.0).collect())
    }

    /// MATLAB's name of the class.
    pub fn class_name(&self) -> &'static str {
        NumberKind::CLASSES[self.kind() as usize].1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_byte_orders_and_narrow_storage_give_the_same_doubles() {
        let little = Numbers::decode(
            NumberKind::I16,
            &[0xFE, 0xFF, 0x03, 0x00],
            ByteOrder::Little,
        );
        let big = Numbers::decode(NumberKind::I16, &[0xFF, 0xFE, 0x00, 0x03], ByteOrder::Big);
        assert_eq!(little, Numbers::I16(vec![-2, 3]));
        assert_eq!(little, big);
        assert_eq!(
            little.into_kind(NumberKind::F64),
            Numbers::F64(vec![-2.0, 3.0])
        );
    }

    #[test]
    fn sixty_four_bit_integers_stay_exact() {
        let value = (1_u64 << 53) + 1;
        let numbers = Numbers::decode(NumberKind::U64, &value.to_be_bytes(), ByteOrder::Big);
        assert_eq!(numbers, Numbers::U64(vec![value]));
    }
}
