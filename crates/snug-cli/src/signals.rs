//! Ctrl-C and the signals by which a system ends a program.

use crate::exit;
use crate::terminal::complain;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Becomes true with the first Ctrl-C, SIGTERM or SIGHUP; the second ends the program at once.
///
/// SIGHUP stays ignored where it was ignored at the start, as under `nohup`.
pub fn interruption() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    if let Err(error) = listen(Arc::clone(&interrupted)) {
        tracing::warn!(%error, "a signal will stop the program at once instead of after what is at hand");
    }
    interrupted
}

/// Interrupts as the first signal does once `time` has passed, unless what it limits `is_over` by then; becomes true where it was that which
/// did.
pub fn after(
    time: Duration,
    interrupted: &Arc<AtomicBool>,
    is_over: &Arc<AtomicBool>,
) -> Arc<AtomicBool> {
    let is_up = Arc::new(AtomicBool::new(false));
    let (interrupted, told) = (Arc::clone(interrupted), Arc::clone(&is_up));
    let is_over = Arc::clone(is_over);
    std::thread::spawn(move || {
        std::thread::sleep(time);
        if is_over.load(Ordering::Relaxed) {
            return;
        }
        let was_ended = interrupted.swap(true, Ordering::Relaxed);
        told.store(!was_ended, Ordering::Relaxed);
    });
    is_up
}

#[cfg(unix)]
fn listen(interrupted: Arc<AtomicBool>) -> std::io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let mut listened = vec![SIGINT, SIGTERM];
    if !is_ignored(SIGHUP) {
        listened.push(SIGHUP);
    }
    let mut signals = signal_hook::iterator::Signals::new(listened)?;
    std::thread::Builder::new()
        .name("signals".to_owned())
        .spawn(move || signals.forever().for_each(|_| stop(&interrupted)))?;
    Ok(())
}

/// Whether the process was started with a signal ignored.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))
        .and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

#[cfg(not(unix))]
fn listen(interrupted: Arc<AtomicBool>) -> std::io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::flag;
    for signal in [SIGINT, SIGTERM] {
        let code = exit::INTERRUPTED.into();
        flag::register_conditional_shutdown(signal, code, Arc::clone(&interrupted))?;
        flag::register(signal, Arc::clone(&interrupted))?;
    }
    Ok(())
}

/// The first time politely.
#[cfg(unix)]
fn stop(interrupted: &AtomicBool) {
    if interrupted.swap(true, Ordering::Relaxed) {
        std::process::exit(exit::INTERRUPTED.into());
    }
    complain("stopping after what is at hand; once more stops at once");
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether work that is over, or not, by the time is interrupted, and whether that was for the time.
    fn interrupts(is_over: bool) -> (bool, bool) {
        let interrupted = Arc::new(AtomicBool::new(false));
        let time = Duration::from_millis(1);
        let is_up = after(time, &interrupted, &Arc::new(AtomicBool::new(is_over)));
        std::thread::sleep(Duration::from_millis(200));
        (
            interrupted.load(Ordering::Relaxed),
            is_up.load(Ordering::Relaxed),
        )
    }

    #[test]
    fn a_limit_interrupts_what_it_limits_and_not_what_comes_after() {
        assert_eq!(interrupts(false), (true, true));
        assert_eq!(interrupts(true), (false, false));
    }
}
