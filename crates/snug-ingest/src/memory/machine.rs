//! What the machine, the control group and the process's own limit leave to this process.

use std::path::Path;

/// The least of what the limits leave \[bytes\]; `None` where the system does not say.
pub(super) fn available_bytes() -> Option<u64> {
    [
        free_memory_bytes(),
        control_group_bytes(),
        address_space_bytes(),
    ]
    .into_iter()
    .flatten()
    .min()
}

/// Memory that can be had without swapping.
fn free_memory_bytes() -> Option<u64> {
    let memory = std::fs::read_to_string("/proc/meminfo").ok()?;
    kilobytes(&memory, "MemAvailable:")
}

/// What the control groups (version 2) of this process leave, its own and those around it.
fn control_group_bytes() -> Option<u64> {
    let groups = std::fs::read_to_string("/proc/self/cgroup").ok()?;
    let group = groups.lines().find_map(|line| line.strip_prefix("0::/"))?;
    let root = Path::new("/sys/fs/cgroup");
    root.join(group)
        .ancestors()
        .take_while(|folder| folder.starts_with(root))
        .filter_map(left_in_group)
        .min()
}

fn left_in_group(folder: &Path) -> Option<u64> {
    let number = |name: &str| -> Option<u64> {
        let text = std::fs::read_to_string(folder.join(name)).ok()?;
        text.trim().parse().ok() // `max` is no limit.
    };
    let used = number("memory.current")?.saturating_sub(reclaimable_bytes(folder));
    Some(number("memory.max")?.saturating_sub(used))
}

/// Pages of files that were read count as used, but are given up as soon as memory is asked for.
fn reclaimable_bytes(group: &Path) -> u64 {
    std::fs::read_to_string(group.join("memory.stat"))
        .ok()
        .and_then(|text| {
            text.lines()
                .find_map(|line| line.strip_prefix("inactive_file "))?
                .trim()
                .parse()
                .ok()
        })
        .unwrap_or(0)
}

/// What the limit of the address space (`ulimit -v`) leaves.
#[cfg(unix)]
fn address_space_bytes() -> Option<u64> {
    let limit = rustix::process::getrlimit(rustix::process::Resource::As).current?;
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    Some(limit.saturating_sub(kilobytes(&status, "VmSize:")?))
}

#[cfg(not(unix))]
fn address_space_bytes() -> Option<u64> {
    None
}

/// The number behind a name in a table of `/proc`, whose unit is 1024 bytes.
fn kilobytes(table: &str, name: &str) -> Option<u64> {
    let number = table.lines().find_map(|line| line.strip_prefix(name))?;
    let number: u64 = number.split_whitespace().next()?.parse().ok()?;
    number.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_of_the_system_are_understood() {
        let table = "MemTotal:  100 kB\nMemAvailable:   25 kB\n";
        assert_eq!(kilobytes(table, "MemAvailable:"), Some(25 * 1024));
        assert_eq!(kilobytes(table, "VmSize:"), None);
    }

    #[test]
    fn what_a_group_leaves() {
        let group = tempfile::tempdir().expect("a temporary folder");
        let write = |name: &str, text: &str| {
            std::fs::write(group.path().join(name), text).expect("room on the disk");
        };
        assert_eq!(left_in_group(group.path()), None);
        write("memory.current", "700\n");
        write("memory.max", "max\n");
        assert_eq!(left_in_group(group.path()), None);
        write("memory.max", "1000\n");
        assert_eq!(left_in_group(group.path()), Some(300));
        write("memory.stat", "anon 100\ninactive_file 500\n");
        assert_eq!(left_in_group(group.path()), Some(800));
    }
}
