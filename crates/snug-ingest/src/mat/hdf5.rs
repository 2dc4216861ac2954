//! Version 7.3: HDF5 with MATLAB's conventions, read through `hdf5-pure`.
//!
//! A variable is a dataset (its shape reversed) or a group (struct, sparse matrix); its class stands in the attribute
//! `MATLAB_class`. Cells and struct arrays are datasets of references into the hidden group `#refs#`. Files without
//! the attributes, as other programs write them, get the class of their HDF5 type.

mod budget;
mod old_layout;
mod raw;

use super::{Content, Field, MAXIMUM_DEPTH, Numbers, Sparse, Unsupported, Value, Variable};
use crate::IngestError;
use budget::Budget;
use hdf5_pure::{AttrValue, Dataset, File, FormatError, Group, Object};
use raw::Elements;
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

type Attributes = HashMap<String, AttrValue>;

/// All variables of a version 7.3 file, by name.
pub(super) fn variables(bytes: Vec<u8>) -> Result<Vec<Variable>, IngestError> {
    // The HDF5 library promises errors, not panics, but it is large and the files are strangers': a panic inside it
    // must cost this file only. Nothing of its state outlives the call.
    catch_unwind(AssertUnwindSafe(|| {
        let open = |bytes| File::from_bytes(bytes).map_err(|error| failed("/", error));
        let file = open(bytes)?;
        match root(&file) {
            Err(error) if is_old_layout(&error) => {
                let mut bytes = file.as_bytes().to_vec();
                if old_layout::modernise(&mut bytes) {
                    root(&open(bytes)?)
                } else {
                    Err(error)
                }
            }
            read => read,
        }
    }))
    .unwrap_or(Err(IngestError::Hdf5Panic))
}

fn root(file: &File) -> Result<Vec<Variable>, IngestError> {
    let budget = Budget::for_file(file.as_bytes().len());
    Reader { budget }.root(&file.root())
}

fn is_old_layout(error: &IngestError) -> bool {
    matches!(
        error,
        IngestError::Hdf5 { source, .. }
            if matches!(**source, hdf5_pure::Error::Format(FormatError::InvalidLayoutVersion(1 | 2)))
    )
}

fn failed(object: &str, error: hdf5_pure::Error) -> IngestError {
    IngestError::Hdf5 {
        object: object.to_owned(),
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

struct Reader {
    budget: Budget,
}

impl Reader {
    fn root(mut self, root: &Group) -> Result<Vec<Variable>, IngestError> {
        let mut variables = Vec::new();
        for (name, dataset) in root.iter_datasets().map_err(|error| failed("/", error))? {
            let attributes = dataset.attrs().map_err(|error| failed(&name, error))?;
            variables.push(Variable {
                value: self.dataset(&name, &dataset, 0)?,
                global: is_set(&attributes, "MATLAB_global"),
                name,
            });
        }
        for (name, group) in root.iter_groups().map_err(|error| failed("/", error))? {
            // `#refs#` and `#subsystem#` hold what variables refer to.
            if !name.starts_with('#') {
                let attributes = group.attrs().map_err(|error| failed(&name, error))?;
                variables.push(Variable {
                    value: self.group(&name, &group, 0)?,
                    global: is_set(&attributes, "MATLAB_global"),
                    name,
                });
            }
        }
        variables.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(variables)
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
        self.budget.enter(path, depth)?;
        let failed = |error| failed(path, error);
        let attributes = dataset.attrs().map_err(failed)?;
        let class = matlab_class(&attributes);
        if let Some(value) = unsupported_class(&attributes) {
            return Ok(value);
        }
        self.budget.spend(path, dataset)?;
        if is_set(&attributes, "MATLAB_empty") {
            return empty(path, dataset, &attributes);
        }
        let dims = matlab_dims(dataset.shape().map_err(failed)?);
        let elements = raw::elements(path, dataset)?;
        let content = match elements {
            Elements::References => {
                let objects = match dataset.dereference() {
                    // Cells that were never filled refer to nothing.
                    Err(hdf5_pure::Error::Format(FormatError::InvalidObjectReference {
                        ..
                    })) => {
                        return Ok(foreign("references to nothing".to_owned()));
                    }
                    objects => objects.map_err(failed)?,
                };
                let mut values = Vec::with_capacity(objects.len());
                for (index, object) in objects.iter().enumerate() {
                    values.push(self.object(
                        &format!("{path}{{{}}}", index + 1),
                        object,
                        depth + 1,
                    )?);
                }
                Content::Cell(values)
            }
            Elements::Numbers(real) => numeric(real, class),
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

    fn group(&mut self, path: &str, group: &Group, depth: usize) -> Result<Value, IngestError> {
        self.budget.enter(path, depth)?;
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
                object: path.to_owned(),
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
            object: path.to_owned(),
        };
        let rows = raw::attribute_number(rows).ok_or_else(failed_parts)?;
        let mut part = |name: &str| -> Result<Option<Elements>, IngestError> {
            let Ok(dataset) = group.dataset(name) else {
                return Ok(None);
            };
            self.budget.spend(path, &dataset)?;
            raw::elements(path, &dataset).map(Some)
        };
        let numbers = |elements: Option<Elements>| match elements {
            None => Some((Vec::new(), None)),
            Some(Elements::Numbers(real)) => Some((real.to_f64(), None)),
            Some(Elements::Complex(real, imaginary)) => {
                Some((real.to_f64(), Some(imaginary.to_f64())))
            }
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

/// Numbers whose class attribute says they stand for something else.
fn numeric(real: Numbers, class: Option<&str>) -> Content {
    match class {
        Some("logical") => Content::Logical(real.to_logical()),
        Some("char") => {
            let units = real.to_f64().into_iter().map(|unit| unit as u16);
            Content::Text(
                char::decode_utf16(units)
                    .map(|unit| unit.unwrap_or(char::REPLACEMENT_CHARACTER))
                    .collect(),
            )
        }
        _ => Content::Numeric {
            real,
            imaginary: None,
        },
    }
}

/// An empty array stores its shape as its data.
fn empty(path: &str, dataset: &Dataset, attributes: &Attributes) -> Result<Value, IngestError> {
    let dims = match raw::elements(path, dataset)? {
        Elements::Numbers(numbers) => numbers.to_f64().iter().map(|&n| n as usize).collect(),
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
    Ok(Value { dims, content })
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
impl Budget {
    fn enter(&mut self, path: &str, depth: usize) -> Result<(), IngestError> {
        if depth > MAXIMUM_DEPTH {
            return Err(IngestError::Hdf5NestedTooDeep {
                object: path.chars().take(80).collect(),
                limit: MAXIMUM_DEPTH,
            });
        }
        self.count_object(path)
    }
}
