//! Version 7.3: HDF5 with MATLAB's conventions, read through `hdf5-pure`.
//!
//! A variable is a dataset (its shape reversed) or a group (struct, sparse matrix); its class stands in the attribute
//! `MATLAB_class`. Cells and struct arrays are datasets of references into the hidden group `#refs#`. Files without
//! the attributes, as other programs write them, get the class of their HDF5 type.

mod effort;
mod old_layout;
mod raw;
mod stored;

use super::selection::{MatSelection, Wanted};
use super::{
    Content, Field, MAXIMUM_DEPTH, MatFormat, Numbers, Sparse, Unsupported, Value, Variable,
};
use crate::error::IngestError;
use crate::memory::Budget;
use effort::Effort;
use hdf5_pure::{AttrValue, Dataset, File, FormatError, Group, Object};
use raw::Elements;
use snug_campaign::excerpt;
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use stored::Stored;

/// What an open object of the HDF5 library takes, its parsed header with it (measured: 2200) \[bytes\].
const OBJECT_BYTES: usize = 2560;

/// HDF5 itself has no more.
const MOST_DIMENSIONS: usize = 32;

type Attributes = HashMap<String, AttrValue>;

/// The wanted variables of a version 7.3 file, by name.
pub(super) fn select(
    content: Vec<u8>,
    wanted: Wanted<'_>,
    budget: &Budget,
) -> Result<MatSelection, IngestError> {
    // The HDF5 library promises errors, not panics, but it is large and the files are strangers': a panic inside it
    // must cost this file only. Nothing of its state outlives the call.
    catch_unwind(AssertUnwindSafe(|| {
        let stored = Stored::new(content);
        let mark = budget.mark();
        let read = root(&stored, wanted, budget);
        if !is_old_layout(&read) {
            return read;
        }
        budget.back_to(mark);
        let mut bytes = stored.into_bytes();
        if !old_layout::modernise(&mut bytes) {
            return read;
        }
        root(&Stored::new(bytes), wanted, budget)
    }))
    .unwrap_or(Err(IngestError::Hdf5Panic))
}

fn root(stored: &Stored, wanted: Wanted<'_>, budget: &Budget) -> Result<MatSelection, IngestError> {
    let file = File::from_source(stored.clone()).map_err(|error| failed("/", error))?;
    let effort = Effort::for_file(stored.length(), budget);
    let mut selection = MatSelection::new(MatFormat::Hdf5);
    Reader { effort, budget }.root(&file.root(), wanted, &mut selection)?;
    stored.check()?;
    selection.variables.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(selection)
}

fn is_old_layout(read: &Result<MatSelection, IngestError>) -> bool {
    let old = |error: &IngestError| {
        matches!(
            error,
            IngestError::Hdf5 { source, .. }
                if matches!(**source, hdf5_pure::Error::Format(FormatError::InvalidLayoutVersion(1 | 2)))
        )
    };
    match read {
        Ok(selection) => selection.unreadable.iter().any(|v| old(&v.reason)),
        Err(error) => old(error),
    }
}

fn failed(object: &str, error: hdf5_pure::Error) -> IngestError {
    IngestError::Hdf5 {
        object: excerpt(object),
        source: Box::new(error),
    }
}

/// The class of an object, as its attribute names it.
fn matlab_class(attributes: &Attributes) -> Option<&str> {
    attributes.get("MATLAB_class")?.as_str()
}

/// Whether an attribute is there and not zero.
fn is_set(attributes: &Attributes, name: &str) -> bool {
    attributes
        .get(name)
        .is_some_and(|value| raw::attribute_number(value) != Some(0))
}

/// Function handles and instances of classes, whose inside lies in a hidden part of the file.
fn unsupported_class(attributes: &Attributes) -> Option<Value> {
    const OLD_STYLE_OBJECT: usize = 2;
    let class = matlab_class(attributes).unwrap_or_default();
    if class == "function_handle" {
        return Some(unsupported(Unsupported::FunctionHandle));
    }
    let decode = raw::attribute_number(attributes.get("MATLAB_object_decode")?);
    (decode != Some(OLD_STYLE_OBJECT)).then(|| {
        unsupported(Unsupported::Opaque {
            class_name: class.to_owned(),
        })
    })
}

struct Reader<'a> {
    effort: Effort<'a>,
    budget: &'a Budget,
}

impl Reader<'_> {
    fn root(
        mut self,
        root: &Group,
        wanted: Wanted<'_>,
        selection: &mut MatSelection,
    ) -> Result<(), IngestError> {
        for (name, dataset) in root.iter_datasets().map_err(|error| failed("/", error))? {
            if selection.note(&name, wanted, self.budget)? {
                let value = self.dataset(&name, &dataset, 0);
                let read = value.and_then(|value| variable(&name, dataset.attrs(), value));
                selection.keep(name, read, self.budget)?;
            }
        }
        for (name, group) in root.iter_groups().map_err(|error| failed("/", error))? {
            // `#refs#` and `#subsystem#` hold what variables refer to.
            if !name.starts_with('#') && selection.note(&name, wanted, self.budget)? {
                let value = self.group(&name, &group, 0);
                let read = value.and_then(|value| variable(&name, group.attrs(), value));
                selection.keep(name, read, self.budget)?;
            }
        }
        Ok(())
    }

    /// Reads a dataset's elements.
    fn elements(&mut self, path: &str, dataset: &Dataset) -> Result<Elements, IngestError> {
        let on_the_way = self.effort.spend(path, dataset)?;
        let elements = raw::elements(path, dataset)?;
        self.budget.give_back(on_the_way);
        Ok(elements)
    }

    fn object(&mut self, path: &str, object: &Object, depth: usize) -> Result<Value, IngestError> {
        match object {
            Object::Group(group) => self.group(path, group, depth),
            Object::Dataset(dataset) => self.dataset(path, dataset, depth),
            _ => Ok(foreign("committed datatype".to_owned())),
        }
    }

    fn dataset(
        &mut self,
        path: &str,
        dataset: &Dataset,
        depth: usize,
    ) -> Result<Value, IngestError> {
        self.effort.enter(path, depth)?;
        let failed = |error| failed(path, error);
        let attributes = dataset.attrs().map_err(failed)?;
        let class = matlab_class(&attributes);
        if let Some(value) = unsupported_class(&attributes) {
            return Ok(value);
        }
        let elements = self.elements(path, dataset)?;
        if is_set(&attributes, "MATLAB_empty") {
            return Ok(empty(elements, &attributes));
        }
        let dims = matlab_dims(dataset.shape().map_err(failed)?);
        let content = match elements {
            Elements::References => match self.referred(path, dataset, &dims, depth)? {
                Some(values) => Content::Cell(values),
                None => return Ok(foreign("references to nothing".to_owned())),
            },
            Elements::Numbers(real) => numeric(real, class, self.budget)?,
            Elements::Complex(real, imaginary) => Content::Numeric {
                real,
                imaginary: Some(imaginary),
            },
            Elements::Logical(values) => Content::Logical(values),
            Elements::Text(text) => {
                let characters: Vec<char> = text.chars().collect();
                return Ok(Value {
                    dims: vec![1, characters.len()],
                    content: Content::Text(characters),
                });
            }
            Elements::Foreign(datatype) => {
                Content::Unsupported(Unsupported::ForeignHdf5 { datatype })
            }
        };
        Ok(Value { dims, content })
    }

    /// The elements of a cell; `None` for cells that were never filled, which refer to nothing.
    fn referred(
        &mut self,
        path: &str,
        dataset: &Dataset,
        dims: &[usize],
        depth: usize,
    ) -> Result<Option<Vec<Value>>, IngestError> {
        let count = dims
            .iter()
            .fold(1, |count: usize, &length| count.saturating_mul(length));
        let before = self.budget.mark();
        self.budget.spend_on::<[u8; OBJECT_BYTES]>("cells", count)?;
        let objects = match dataset.dereference() {
            Err(hdf5_pure::Error::Format(FormatError::InvalidObjectReference { .. })) => {
                return Ok(None);
            }
            objects => objects.map_err(|error| failed(path, error))?,
        };
        let handles = self.budget.mark() - before;
        let mut values = self.budget.list("cells", objects.len())?;
        for (index, object) in objects.iter().enumerate() {
            values.push(self.object(&format!("{path}{{{}}}", index + 1), object, depth + 1)?);
        }
        self.budget.give_back(handles);
        Ok(Some(values))
    }

    fn group(&mut self, path: &str, group: &Group, depth: usize) -> Result<Value, IngestError> {
        self.effort.enter(path, depth)?;
        let attributes = group.attrs().map_err(|error| failed(path, error))?;
        let class = matlab_class(&attributes);
        if let Some(rows) = attributes.get("MATLAB_sparse") {
            return self.sparse(path, group, rows, class);
        }
        if let Some(value) = unsupported_class(&attributes) {
            return Ok(value);
        }
        let class_name = class.filter(|&class| class != "struct").map(str::to_owned);
        self.structure(path, group, &attributes, class_name, depth)
    }

    /// A group is a struct. Where its members are reference datasets without a class of their own it is a struct array.
    fn structure(
        &mut self,
        path: &str,
        group: &Group,
        attributes: &Attributes,
        class_name: Option<String>,
        depth: usize,
    ) -> Result<Value, IngestError> {
        let failed = |error| failed(path, error);
        let mut members = Vec::new();
        let mut array_dims = None;
        for (name, dataset) in group.iter_datasets().map_err(failed)? {
            let own = dataset.attrs().map_err(failed)?;
            let value = self.dataset(&format!("{path}.{name}"), &dataset, depth + 1)?;
            let classless = matlab_class(&own).is_none();
            let values = match value {
                Value {
                    dims,
                    content: Content::Cell(values),
                } if classless => {
                    array_dims = Some(dims);
                    values
                }
                value => vec![value],
            };
            members.push(Field { name, values });
        }
        for (name, child) in group.iter_groups().map_err(failed)? {
            let value = self.group(&format!("{path}.{name}"), &child, depth + 1)?;
            members.push(Field {
                name,
                values: vec![value],
            });
        }
        let dims = array_dims.unwrap_or_else(|| vec![1, 1]);
        let count: usize = dims.iter().product();
        if members.iter().any(|field| field.values.len() != count) {
            return Err(IngestError::Hdf5Fields {
                object: excerpt(path),
                expected: count,
            });
        }
        sort_fields(&mut members, attributes);
        Ok(Value {
            dims,
            content: Content::Struct {
                class_name,
                fields: members,
            },
        })
    }

    /// A sparse matrix is a group with `jc`, and `ir` and `data` where it is not all zero.
    fn sparse(
        &mut self,
        path: &str,
        group: &Group,
        rows: &AttrValue,
        class: Option<&str>,
    ) -> Result<Value, IngestError> {
        let failed_parts = || IngestError::Hdf5SparseParts {
            object: excerpt(path),
        };
        let rows = raw::attribute_number(rows).ok_or_else(failed_parts)?;
        let mut part = |name: &str| -> Result<Option<Elements>, IngestError> {
            let Ok(dataset) = group.dataset(name) else {
                return Ok(None);
            };
            let elements = self.elements(path, &dataset)?;
            // As doubles, and the places in the matrix.
            let count: u64 = dataset.shape().map_or(0, |shape| shape.iter().product());
            self.budget
                .spend("a sparse matrix", count.saturating_mul(4 * 8))?;
            Ok(Some(elements))
        };
        let numbers = |elements: Option<Elements>| match elements {
            None => Some((Vec::new(), None)),
            Some(Elements::Numbers(real)) => Some((real.into_f64(), None)),
            Some(Elements::Complex(real, imaginary)) => {
                Some((real.into_f64(), Some(imaginary.into_f64())))
            }
            Some(Elements::Logical(values)) => Some((
                values
                    .into_iter()
                    .map(|value| f64::from(u8::from(value)))
                    .collect(),
                None,
            )),
            Some(_) => None,
        };
        let (starts, _) = numbers(part("jc")?).ok_or_else(failed_parts)?;
        let (row_indices, _) = numbers(part("ir")?).ok_or_else(failed_parts)?;
        let (real, imaginary) = numbers(part("data")?).ok_or_else(failed_parts)?;
        let columns = starts.len().checked_sub(1).ok_or_else(failed_parts)?;
        let dims = vec![rows, columns];
        let logical = class == Some("logical");
        Sparse::from_columns(&dims, &row_indices, &starts, real, imaginary, logical)
            .map(|sparse| Value {
                dims,
                content: Content::Sparse(sparse),
            })
            .ok_or_else(failed_parts)
    }
}

/// What stands in the attributes and in the value, under its name.
fn variable(
    name: &str,
    attributes: Result<Attributes, hdf5_pure::Error>,
    value: Value,
) -> Result<Variable, IngestError> {
    let attributes = attributes.map_err(|error| failed(name, error))?;
    Ok(Variable {
        name: name.to_owned(),
        global: is_set(&attributes, "MATLAB_global"),
        value,
    })
}

/// Numbers whose class attribute says they stand for something else.
fn numeric(real: Numbers, class: Option<&str>, budget: &Budget) -> Result<Content, IngestError> {
    match class {
        Some("logical") => {
            budget.spend_on::<bool>("truth values", real.len())?;
            budget.give_back(real.bytes());
            Ok(Content::Logical(real.to_logical()))
        }
        Some("char") => {
            // The units as doubles, and characters in a list that grows by doubling.
            budget.spend_on::<(f64, [char; 2])>("characters", real.len())?;
            let units = real.into_f64().into_iter().map(|unit| unit as u16);
            Ok(Content::Text(
                char::decode_utf16(units)
                    .map(|unit| unit.unwrap_or(char::REPLACEMENT_CHARACTER))
                    .collect(),
            ))
        }
        _ => Ok(Content::Numeric {
            real,
            imaginary: None,
        }),
    }
}

/// An empty array stores its shape as its data.
fn empty(stored: Elements, attributes: &Attributes) -> Value {
    let dims: Vec<usize> = match stored {
        Elements::Numbers(numbers) if numbers.len() <= MOST_DIMENSIONS => {
            numbers.to_f64().iter().map(|&n| n as usize).collect()
        }
        _ => vec![0, 0],
    };
    let content = match matlab_class(attributes) {
        Some("char") => Content::Text(Vec::new()),
        Some("cell") => Content::Cell(Vec::new()),
        Some("logical") => Content::Logical(Vec::new()),
        Some("struct") => Content::Struct {
            class_name: None,
            fields: declared_fields(attributes)
                .iter()
                .map(|name| Field {
                    name: name.clone(),
                    values: Vec::new(),
                })
                .collect(),
        },
        class => Content::Numeric {
            real: raw::no_numbers(class),
            imaginary: None,
        },
    };
    Value { dims, content }
}

/// HDF5 stores rows where MATLAB stores columns, so a shape reads backwards; scalars and vectors of other programs
/// become columns.
fn matlab_dims(shape: Vec<u64>) -> Vec<usize> {
    let mut dims: Vec<usize> = shape
        .into_iter()
        .rev()
        .map(|length| usize::try_from(length).unwrap_or(usize::MAX))
        .collect();
    while dims.len() < 2 {
        dims.push(1);
    }
    dims
}

/// A struct's fields in the order of their declaration, where the file says it.
fn declared_fields(attributes: &Attributes) -> &[String] {
    attributes
        .get("MATLAB_fields")
        .and_then(AttrValue::as_strings)
        .unwrap_or_default()
}

fn sort_fields(fields: &mut [Field], attributes: &Attributes) {
    let declared = declared_fields(attributes);
    let place = |name: &str| declared.iter().position(|field| field == name);
    fields.sort_by(|a, b| {
        let key = |field: &Field| place(&field.name).unwrap_or(usize::MAX);
        key(a).cmp(&key(b)).then_with(|| a.name.cmp(&b.name))
    });
}

fn foreign(datatype: String) -> Value {
    unsupported(Unsupported::ForeignHdf5 { datatype })
}

fn unsupported(what: Unsupported) -> Value {
    Value {
        dims: Vec::new(),
        content: Content::Unsupported(what),
    }
}

/// Guards against files that refer to themselves or claim more than they hold.
impl Effort<'_> {
    fn enter(&mut self, path: &str, depth: usize) -> Result<(), IngestError> {
        if depth > MAXIMUM_DEPTH {
            return Err(IngestError::Hdf5NestedTooDeep {
                object: excerpt(path),
                limit: MAXIMUM_DEPTH,
            });
        }
        self.count_object(path)
    }
}
