//! A writer that takes nothing more once a call has failed, and how MCAP is written through it.

use crate::error::RecordError;
use mcap::write::NoSeek;
use mcap::{McapError, WriteOptions, Writer};
use std::io::{Error, ErrorKind, Result, Write};

/// An MCAP writer whose file stays readable up to its last flush.
pub(crate) type LastingWriter<'w> = Writer<NoSeek<UntilFailure<'w>>>;

/// How chunks are written.
pub(crate) fn options(chunk_bytes: u64) -> WriteOptions {
    WriteOptions::new()
        // No worker threads: the chunks are small, and the bytes must not depend on the machine.
        .compression_level(1)
        .compression_threads(0)
        .chunk_size(Some(chunk_bytes))
        // A chunk is put together in memory and written whole, so that a killed run leaves no half-open chunk
        // without a length.
        .disable_seeking(true)
}

/// Ends the file with its index.
pub(crate) fn finish(mut writer: LastingWriter<'_>) -> std::result::Result<(), RecordError> {
    writer.finish()?;
    let mut inner = writer.into_inner().into_inner();
    Ok(inner.flush().map_err(McapError::from)?)
}

/// Passes everything on until the first failure, and gives that failure again ever after.
///
/// Half a record may stand at the end then. What is written behind it (by a caller that goes on, or by the MCAP writer,
/// which ends the file when it is dropped) would be taken for the rest of that record.
pub(crate) struct UntilFailure<'w> {
    writer: Box<dyn Write + 'w>,
    failure: Option<(ErrorKind, Option<i32>)>,
}

impl<'w> UntilFailure<'w> {
    pub(crate) fn new(writer: impl Write + 'w) -> Self {
        Self {
            writer: Box::new(writer),
            failure: None,
        }
    }

    fn call<T>(&mut self, call: impl FnOnce(&mut dyn Write) -> Result<T>) -> Result<T> {
        if let Some((kind, code)) = self.failure {
            return Err(code.map_or_else(|| kind.into(), Error::from_raw_os_error));
        }
        let result = call(&mut *self.writer);
        if let Err(error) = &result
            && error.kind() != ErrorKind::Interrupted
        {
            self.failure = Some((error.kind(), error.raw_os_error()));
        }
        result
    }
}

impl Write for UntilFailure<'_> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        self.call(|writer| writer.write(bytes))
    }

    fn flush(&mut self) -> Result<()> {
        self.call(|writer| writer.flush())
    }
}
