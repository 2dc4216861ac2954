//! Signals by which people and systems end a program.

use crate::program::{ended, fixture, results, said, snug, snug_below, text, words};
use std::process::{Child, Command};
use std::time::Duration;

fn send(signal: &str, child: &Child) {
    let pid = child.id().to_string();
    assert!(
        Command::new("kill")
            .args([signal, &pid])
            .status()
            .unwrap()
            .success()
    );
}

/// A verb on the mystery, sent a signal once it has begun the stage named.
fn signalled(verb: &[&str], stage: &str, signal: &str) -> (i32, String, crate::program::Results) {
    use std::io::{BufRead, BufReader, Read};
    let out = tempfile::tempdir().unwrap();
    let data = fixture("mystery");
    let mut words = verb.to_vec();
    words.extend([
        "--data",
        text(&data),
        "--out",
        text(out.path()),
        "--threads",
        "1",
    ]);
    let mut child = snug(&words).spawn().unwrap();
    let mut errors = BufReader::new(child.stderr.take().unwrap());
    let mut heard = String::new();
    while !heard.contains(stage) {
        assert!(
            errors.read_line(&mut heard).unwrap() > 0,
            "{stage}: {heard}"
        );
    }
    send(signal, &child);
    errors.read_to_string(&mut heard).unwrap();
    let output = child.wait_with_output().unwrap();
    let code = output.status.code().unwrap_or(-1);
    (code, heard + &said(&output), results(out.path()))
}

#[test]
fn every_verb_writes_what_it_has_and_marks_it() {
    for signal in ["-TERM", "-HUP", "-INT"] {
        for verb in [
            &["diagnose"] as &[&str],
            &["improve"],
            &["add", "stretch_reflex"],
        ] {
            let stage = if verb[0] == "add" {
                "adding"
            } else {
                "ranking"
            };
            let (code, said, results) = signalled(verb, stage, signal);
            assert_eq!(code, 130, "{verb:?} {signal}: {said}");
            let stopped = "Stopped before an effect was added";
            assert!(said.contains(stopped), "{verb:?} {signal}: {said}");
            let verdict = String::from_utf8_lossy(&results["verdict.json"]);
            assert!(
                verdict.contains("\"interrupted\": true"),
                "{verb:?} {signal}"
            );
            let report = String::from_utf8_lossy(&results["report.html"]);
            assert!(
                report.contains("stopped before there was a verdict"),
                "{verb:?} {signal}"
            );
        }
    }
}

/// As the first signal does, but nothing failed. A second is enough to read twelve tightenings and for nothing else.
#[test]
fn a_time_limit_ends_with_what_was_found_and_marks_it() {
    let out = tempfile::tempdir().unwrap();
    let data = fixture("mystery");
    let limited = |time: &str| {
        let words = ["improve", "--data", text(&data), "--out", text(out.path())];
        let words = [&words[..], &["--threads", "1", "--time", time]].concat();
        snug(&words).output().unwrap()
    };
    let output = limited("0.6s");
    let heard = said(&output);
    assert_eq!(output.status.code(), Some(0), "{heard}");
    assert!(
        heard.contains("Stopped before an effect was added"),
        "{heard}"
    );
    let verdict = &results(out.path())["verdict.json"];
    assert!(String::from_utf8_lossy(verdict).contains("\"interrupted\": true"));

    for wrong in ["0", "soon", "inf"] {
        let output = limited(wrong);
        assert_eq!(output.status.code(), Some(2), "{wrong}");
        assert!(said(&output).contains("--time"), "{wrong}");
    }
}

#[test]
fn a_run_that_is_stopped_says_which_files_it_did_not_reach() {
    let out = tempfile::tempdir().unwrap();
    let data = fixture("campaign");
    let words = [
        "run",
        "--data",
        text(&data),
        "--out",
        text(out.path()),
        "--threads",
        "1",
    ];
    for _ in 0..20 {
        let child = snug(&words).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(150));
        send("-TERM", &child);
        let output = child.wait_with_output().unwrap();
        let said = said(&output);
        if output.status.code() != Some(130) || !said.contains("Written") {
            continue; // before it listened, or after its end
        }
        let results = results(out.path());
        let findings = String::from_utf8_lossy(&results["findings.json"]).into_owned();
        let table = String::from_utf8_lossy(&results["tightenings.csv"]).into_owned();
        for entry in std::fs::read_dir(&data).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            assert!(
                findings.contains(&name) || table.contains(&name),
                "{name} is nowhere"
            );
        }
        assert!(findings.contains("not_reached"), "{findings}");
        assert!(said.contains("Interrupted"), "{said}");
        return;
    }
    panic!("no signal came in time");
}

/// What `nohup` starts goes on when its terminal is closed.
#[test]
fn a_hang_up_that_was_ignored_stays_ignored() {
    let out = tempfile::tempdir().unwrap();
    let data = fixture("mystery");
    let words = words("diagnose", &data, out.path());
    let child = snug_below(r#"trap "" HUP; exec "$0" "$@""#, &words)
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(500));
    send("-HUP", &child);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
}

#[test]
fn the_second_signal_ends_at_once() {
    let out = tempfile::tempdir().unwrap();
    let data = fixture("mystery");
    let child = snug(&words("improve", &data, out.path())).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(400));
    send("-TERM", &child);
    std::thread::sleep(Duration::from_millis(20));
    send("-TERM", &child);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", said(&output));
    let (code, said) = ended(&mut snug(&words("run", &data, out.path())));
    assert_eq!(code, 0, "{said}");
}
