//! A writer that takes nothing more once a call has failed.

use std::io::{Error, ErrorKind, Result, Write};

/// Passes everything on until the first failure, and gives that failure again ever after.
///
/// Half a record may stand at the end then. What is written behind it (by a caller that goes on, or by the MCAP writer,
/// which ends the file when it is dropped) would be taken for the rest of that record.
pub(crate) struct UntilFailure<W> {
    writer: W,
    failure: Option<(ErrorKind, Option<i32>)>,
}

impl<W> UntilFailure<W> {
    pub(crate) fn new(writer: W) -> Self {
        Self {
            writer,
            failure: None,
        }
    }

    pub(crate) fn into_inner(self) -> W {
        self.writer
    }

    fn call<T>(&mut self, call: impl FnOnce(&mut W) -> Result<T>) -> Result<T> {
        if let Some((kind, code)) = self.failure {
            return Err(code.map_or_else(|| kind.into(), Error::from_raw_os_error));
        }
        let result = call(&mut self.writer);
        if let Err(error) = &result
            && error.kind() != ErrorKind::Interrupted
        {
            self.failure = Some((error.kind(), error.raw_os_error()));
        }
        result
    }
}

impl<W: Write> Write for UntilFailure<W> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        self.call(|writer| writer.write(bytes))
    }

    fn flush(&mut self) -> Result<()> {
        self.call(Write::flush)
    }
}
