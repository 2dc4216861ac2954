//! Files that ask for more memory than there is.

use crate::program::{ended, few_files, results, snug_below, words};
use flate2::{Compression, write::ZlibEncoder};
use std::io::Write;
use std::path::Path;

/// Limit of the process \[KB\] that a machine of 1.5 GB would have.
const LIMIT: &str = r#"ulimit -v 1500000; exec "$0" "$@""#;

/// A level 5 file of one compressed variable of zeros, so many bytes long.
fn bomb(name: &str, inflated_bytes: u32) -> Vec<u8> {
    let mut file = [b' '; 128].to_vec();
    file[..6].copy_from_slice(b"MATLAB");
    file[124..].copy_from_slice(&[0, 1, b'I', b'M']);
    let mut header = Vec::new();
    let mut tag = |kind: u32, bytes: &[u8]| {
        header.extend(kind.to_le_bytes());
        header.extend((bytes.len() as u32).to_le_bytes());
        header.extend(bytes);
        header.resize(header.len().next_multiple_of(8), 0);
    };
    tag(6, &[6, 0, 0, 0, 0, 0, 0, 0]);
    let values = inflated_bytes / 8;
    tag(5, &[values.to_le_bytes(), 1_u32.to_le_bytes()].concat());
    tag(1, name.as_bytes());
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::best());
    let all = header.len() as u32 + 8 + inflated_bytes;
    packed.write_all(&14_u32.to_le_bytes()).unwrap();
    packed.write_all(&all.to_le_bytes()).unwrap();
    packed.write_all(&header).unwrap();
    packed.write_all(&9_u32.to_le_bytes()).unwrap();
    packed.write_all(&inflated_bytes.to_le_bytes()).unwrap();
    let zeros = vec![0; 1 << 20];
    for _ in 0..inflated_bytes >> 20 {
        packed.write_all(&zeros).unwrap();
    }
    let packed = packed.finish().unwrap();
    file.extend(15_u32.to_le_bytes());
    file.extend((packed.len() as u32).to_le_bytes());
    file.extend(packed);
    file
}

fn run(data: &Path, out: &Path) -> (i32, String) {
    let words = words("run", data, out);
    ended(&mut snug_below(LIMIT, &words))
}

#[test]
fn a_file_that_inflates_without_end_is_a_finding_and_the_campaign_goes_on() {
    let data = few_files(2);
    let out = tempfile::tempdir().unwrap();
    let torque = bomb("Inline_Torque", 2000 << 20);
    assert!(torque.len() < 3 << 20);
    std::fs::write(data.path().join("TP8_QS_Soft_5_98.mat"), &torque).unwrap();
    let mut several = torque.clone();
    for name in ["angle_acc_Acc_FIR150", "Events", "nobody_asks_for_this"] {
        several.extend(&bomb(name, 2000 << 20)[128..]);
    }
    std::fs::write(data.path().join("TP8_QS_Soft_5_99.mat"), several).unwrap();
    let (code, said) = run(data.path(), out.path());
    assert_eq!(code, 0, "{said}");
    let results = results(out.path());
    let findings = String::from_utf8_lossy(&results["findings.json"]).into_owned();
    for name in ["TP8_QS_Soft_5_98.mat", "TP8_QS_Soft_5_99.mat", "memory_mb"] {
        assert!(findings.contains(name), "{name}: {findings}");
    }
    let rows = String::from_utf8_lossy(&results["tightenings.csv"])
        .lines()
        .count();
    assert_eq!(rows, 1 + 8, "the good files are evaluated");
}

#[test]
fn a_sparse_file_of_gigabytes_is_a_finding_in_no_time() {
    let data = few_files(1);
    for name in ["TP9_QS_Soft_5_01.mat", "huge.mcap"] {
        let file = std::fs::File::create(data.path().join(name)).unwrap();
        file.set_len(3 << 30).unwrap();
    }
    let out = tempfile::tempdir().unwrap();
    let started = std::time::Instant::now();
    let (code, said) = run(data.path(), out.path());
    assert_eq!(code, 0, "{said}");
    assert!(started.elapsed().as_secs() < 5, "{:?}", started.elapsed());
    let findings = results(out.path()).remove("findings.json").unwrap();
    assert!(String::from_utf8_lossy(&findings).contains("TP9_QS_Soft_5_01.mat"));
}
