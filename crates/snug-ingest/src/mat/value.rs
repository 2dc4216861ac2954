//! The tree that every level of MAT file is read into: variables, arrays, cells, structs, sparse matrices.

use super::Numbers;
use snug_campaign::excerpt;

/// A named value.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Whether it was global when it was saved.
    pub global: bool,
    /// What it holds.
    pub value: Value,
}

/// An array of any class; in MATLAB everything is one.
#[derive(Debug, Clone, PartialEq)]
pub struct Value {
    /// Shape, rows first; empty for unsupported values, whose shape is unknown.
    pub dims: Vec<usize>,
    /// The elements, column-major.
    pub content: Content,
}

/// The elements of an array, in column-major order.
#[derive(Debug, Clone, PartialEq)]
pub enum Content {
    /// Numbers, real or complex.
    Numeric {
        /// Real part.
        real: Numbers,
        /// Imaginary part of a complex array.
        imaginary: Option<Numbers>,
    },
    /// Truth values.
    Logical(Vec<bool>),
    /// Characters. Fewer than the shape says where pairs of UTF-16 units make one character.
    Text(Vec<char>),
    /// A cell array.
    Cell(Vec<Value>),
    /// A struct or struct array, or an instance of an old-style class.
    Struct {
        /// Name of the class for an instance, `None` for a plain struct.
        class_name: Option<String>,
        /// The fields in declaration order.
        fields: Vec<Field>,
    },
    /// A two-dimensional sparse matrix.
    Sparse(Sparse),
    /// Something that this reader cannot give.
    Unsupported(Unsupported),
}

/// One field of a struct array.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// Its value in every element of the struct array.
    pub values: Vec<Value>,
}

/// The entries of a sparse matrix, column by column; everything else is zero. The format knows no units.
#[derive(Debug, Clone, PartialEq)]
pub struct Sparse {
    /// 0-based row of every entry.
    pub rows: Vec<usize>,
    /// 0-based column of every entry, never falling.
    pub columns: Vec<usize>,
    /// Real part of every entry.
    pub real: Vec<f64>,
    /// Imaginary part of every entry.
    pub imaginary: Option<Vec<f64>>,
    /// Whether it is a matrix of truth values.
    pub logical: bool,
}

/// What a file can hold that this reader does not give.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unsupported {
    /// A function handle.
    FunctionHandle,
    /// An instance of a class whose inside only MATLAB knows (`string`, `table`, `datetime`, …).
    Opaque {
        /// Name of the class.
        class_name: String,
    },
    /// A class number that the format's description does not name.
    UnknownClass {
        /// The number.
        number: u32,
    },
    /// An HDF5 object that is no MATLAB value.
    ForeignHdf5 {
        /// Its HDF5 type.
        datatype: String,
    },
}

impl Value {
    /// An empty 0×0 double, as MATLAB's `[]`.
    pub(crate) fn empty() -> Self {
        Self {
            dims: vec![0, 0],
            content: Content::Numeric {
                real: Numbers::F64(Vec::new()),
                imaginary: None,
            },
        }
    }

    /// MATLAB's name of the class.
    pub fn class_name(&self) -> &str {
        match &self.content {
            Content::Numeric { real, .. } => real.class_name(),
            Content::Logical(_) => "logical",
            Content::Text(_) => "char",
            Content::Cell(_) => "cell",
            Content::Struct { class_name, .. } => class_name.as_deref().unwrap_or("struct"),
            Content::Sparse(sparse) if sparse.logical => "logical",
            Content::Sparse(_) => "double",
            Content::Unsupported(Unsupported::FunctionHandle) => "function_handle",
            Content::Unsupported(Unsupported::Opaque { class_name }) => class_name,
            Content::Unsupported(_) => "unknown",
        }
    }

    /// The numbers of a real numeric or logical array as doubles; `None` for anything else.
    pub fn to_f64(&self) -> Option<Vec<f64>> {
        match &self.content {
            Content::Numeric {
                real,
                imaginary: None,
            } => Some(real.to_f64()),
            Content::Logical(values) => {
                Some(values.iter().map(|&v| f64::from(u8::from(v))).collect())
            }
            _ => None,
        }
    }

    /// As [`Value::to_f64`], without a copy where the numbers are doubles.
    pub fn into_f64(self) -> Option<Vec<f64>> {
        match self.content {
            Content::Numeric {
                real,
                imaginary: None,
            } => Some(real.into_f64()),
            _ => self.to_f64(),
        }
    }

    /// How many numbers [`Value::into_f64`] would give, and how many bytes they take as they are.
    pub(crate) fn numbers_held(&self) -> (usize, u64) {
        match &self.content {
            Content::Numeric {
                real,
                imaginary: None,
            } => (real.len(), real.bytes()),
            Content::Logical(values) => (values.len(), values.len() as u64),
            _ => (0, 0),
        }
    }

    /// The text of a character array with at most one row.
    pub fn text(&self) -> Option<String> {
        match &self.content {
            Content::Text(characters) if self.dims.first().is_none_or(|&rows| rows <= 1) => {
                Some(characters.iter().collect())
            }
            _ => None,
        }
    }

    /// The rows of a character matrix, trailing blanks kept.
    pub fn rows(&self) -> Option<Vec<String>> {
        let Content::Text(characters) = &self.content else {
            return None;
        };
        let rows = self.dims.first().copied().unwrap_or(0);
        if rows <= 1 {
            return Some(self.text().into_iter().take(rows).collect());
        }
        // No more rows than characters, so that a shape alone cannot ask for memory.
        Some(
            (0..rows.min(characters.len()))
                .map(|row| characters.iter().skip(row).step_by(rows).collect())
                .collect(),
        )
    }

    /// A struct's field, one value per element.
    pub fn field(&self, name: &str) -> Option<&[Value]> {
        match &self.content {
            Content::Struct { fields, .. } => fields
                .iter()
                .find(|field| field.name == name)
                .map(|field| field.values.as_slice()),
            _ => None,
        }
    }

    /// Whether it is a vector: at most one dimension is not 1.
    pub fn is_vector(&self) -> bool {
        !self.dims.is_empty() && self.dims.iter().filter(|&&length| length != 1).count() <= 1
    }

    /// Shape and class as people write them, `80000×1 single`, `80000×1 complex double`.
    pub fn describe(&self) -> String {
        let shape: Vec<String> = self.dims.iter().map(usize::to_string).collect();
        let complex = if self.is_complex() { "complex " } else { "" };
        let class = excerpt(self.class_name());
        format!("{} {complex}{class}", shape.join("×"))
    }

    /// Whether the numbers have an imaginary part.
    pub fn is_complex(&self) -> bool {
        match &self.content {
            Content::Numeric { imaginary, .. } => imaginary.is_some(),
            Content::Sparse(sparse) => sparse.imaginary.is_some(),
            _ => false,
        }
    }
}

impl Sparse {
    /// From compressed columns: column j holds the entries `starts[j] .. starts[j + 1]`.
    ///
    /// `None` when the parts contradict each other or `dims`, or values are missing. Values beyond the last entry are
    /// spare room, which MATLAB writes too, and are dropped.
    pub(crate) fn from_columns(
        dims: &[usize],
        row_indices: &[f64],
        starts: &[f64],
        mut real: Vec<f64>,
        mut imaginary: Option<Vec<f64>>,
        logical: bool,
    ) -> Option<Self> {
        let &[row_count, column_count] = dims else {
            return None;
        };
        if starts.len() != column_count.checked_add(1)? || starts[0] != 0.0 {
            return None;
        }
        let count = starts[column_count] as usize;
        if !starts.is_sorted() || row_indices.len() < count || real.len() < count {
            return None;
        }
        real.truncate(count);
        if let Some(values) = &mut imaginary {
            if values.len() < count {
                return None;
            }
            values.truncate(count);
        }
        let rows: Vec<usize> = row_indices[..count]
            .iter()
            .map(|&row| row as usize)
            .collect();
        if rows.iter().any(|&row| row >= row_count) || row_indices.iter().any(|&row| row < 0.0) {
            return None;
        }
        let mut columns = Vec::with_capacity(count);
        for (column, bounds) in starts.windows(2).enumerate() {
            columns.extend((bounds[0] as usize..bounds[1] as usize).map(|_| column));
        }
        Some(Self {
            rows,
            columns,
            real,
            imaginary,
            logical,
        })
    }
}
