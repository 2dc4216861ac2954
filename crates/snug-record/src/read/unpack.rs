//! The content of a compressed chunk, piece by piece: memory follows the bytes that come out, never a stated size.

use super::fault::Fault;
use std::io::{ErrorKind, Read};

/// First four bytes of a zstd frame; other numbers begin skippable frames, or formats older than MCAP.
const ZSTD_FRAME: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];
/// zstd's own limit for a window, whatever a frame asks for: 128 MiB.
const WIDEST_WINDOW_LOG: u32 = 27;
/// What zstd's smallest frames ask for: a block of 128 KiB.
const NARROWEST_WINDOW_LOG: u32 = 17;

/// Why no more bytes come out.
#[derive(Debug)]
pub(super) enum Unpacking {
    /// The compressed bytes end within a frame.
    Ended,
    Fault(Fault),
    /// A frame asks for more memory than it may have.
    TooLarge,
}

enum Frame<'a> {
    Zstd(zstd::stream::read::Decoder<'static, &'a [u8]>),
    Lz4(lz4::Decoder<&'a [u8]>),
}

/// Unpacks the frames of one chunk, one after another.
pub(super) struct Unpacker<'a> {
    zstd: bool,
    window_log: u32,
    packed: &'a [u8],
    frame: Option<Frame<'a>>,
}

impl<'a> Unpacker<'a> {
    /// `None` for a compression that is not known.
    pub(super) fn new(compression: &[u8], packed: &'a [u8], memory_bytes: u64) -> Option<Self> {
        let zstd = match compression {
            b"zstd" => true,
            b"lz4" => false,
            _ => return None,
        };
        let window_log = memory_bytes.max(1).ilog2();
        Some(Self {
            zstd,
            window_log: window_log.clamp(NARROWEST_WINDOW_LOG, WIDEST_WINDOW_LOG),
            packed,
            frame: None,
        })
    }

    /// The next bytes; 0 when all frames have come to their end.
    pub(super) fn read(&mut self, out: &mut [u8]) -> Result<usize, Unpacking> {
        loop {
            let frame = match &mut self.frame {
                Some(frame) => frame,
                None if self.packed.is_empty() => return Ok(0),
                None => {
                    let frame = self.open()?;
                    self.frame.insert(frame)
                }
            };
            let length = match frame {
                Frame::Zstd(frame) => frame.read(out),
                Frame::Lz4(frame) => frame.read(out),
            };
            match length {
                Ok(0) => self.close()?,
                Ok(length) => return Ok(length),
                Err(error) => return Err(unpacking(&error)),
            }
        }
    }

    fn open(&self) -> Result<Frame<'a>, Unpacking> {
        let open = |error: std::io::Error| unpacking(&error);
        if !self.zstd {
            return Ok(Frame::Lz4(lz4::Decoder::new(self.packed).map_err(open)?));
        }
        if !self.packed.starts_with(&ZSTD_FRAME) {
            return Err(if ZSTD_FRAME.starts_with(self.packed) {
                Unpacking::Ended
            } else {
                Unpacking::Fault(Fault::Unpack {
                    reason: "it does not begin as a zstd frame".to_owned(),
                })
            });
        }
        let decoder = zstd::stream::read::Decoder::with_buffer(self.packed).map_err(open)?;
        let mut decoder = decoder.single_frame();
        decoder.window_log_max(self.window_log).map_err(open)?;
        Ok(Frame::Zstd(decoder))
    }

    /// Goes on behind the frame that has ended.
    fn close(&mut self) -> Result<(), Unpacking> {
        let rest = match self.frame.take() {
            Some(Frame::Zstd(frame)) => frame.finish(),
            Some(Frame::Lz4(frame)) => {
                let (rest, whole) = frame.finish();
                whole.map_err(|_| Unpacking::Ended)?;
                rest
            }
            None => self.packed,
        };
        if rest.len() >= self.packed.len() {
            return Err(Unpacking::Ended);
        }
        self.packed = rest;
        Ok(())
    }
}

fn unpacking(error: &std::io::Error) -> Unpacking {
    let reason = error.to_string();
    if error.kind() == ErrorKind::UnexpectedEof {
        Unpacking::Ended
    } else if reason.contains("too much memory") {
        Unpacking::TooLarge
    } else {
        Unpacking::Fault(Fault::Unpack { reason })
    }
}
