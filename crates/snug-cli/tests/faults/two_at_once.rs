//! Two runs into one folder.

use crate::program::{ended, expected, fixture, partials, results, said, snug, text};

#[test]
fn of_two_runs_at_once_one_has_the_folder_and_the_other_says_so() {
    let data = [fixture("mystery"), fixture("campaign")];
    let wanted = [expected(&data[0]), expected(&data[1])];
    let mut refused = 0;
    for _ in 0..20 {
        let out = tempfile::tempdir().unwrap();
        let run = |data| {
            let words = ["run", "--data", data, "--out", text(out.path())];
            snug(&words).spawn().unwrap()
        };
        let children = [run(text(&data[0])), run(text(&data[1]))];
        let outputs = children.map(|child| child.wait_with_output().unwrap());
        let codes = outputs.each_ref().map(|output| output.status.code());
        let left = results(out.path());
        assert!(wanted.contains(&left), "a mixture");
        assert!(codes.contains(&Some(0)));
        assert!(partials(out.path()).is_empty());
        if let Some(loser) = outputs.iter().find(|output| !output.status.success()) {
            refused += 1;
            let said = said(loser);
            assert_eq!(loser.status.code(), Some(1), "{said}");
            for told in ["is in use", "since 20", "--wait", "--out", text(out.path())] {
                assert!(said.contains(told), "{told}: {said}");
            }
        }
    }
    assert!(refused >= 15, "they did meet: {refused} of 20");
}

#[test]
fn who_waits_comes_next() {
    let out = tempfile::tempdir().unwrap();
    let (first, second) = (fixture("mystery"), fixture("campaign"));
    let words = |data| ["run", "--data", data, "--out", text(out.path()), "--wait"];
    let mut child = snug(&words(text(&first))).spawn().unwrap();
    let (code, said) = ended(&mut snug(&words(text(&second))));
    assert_eq!(code, 0, "{said}");
    assert!(child.wait().unwrap().success());
    let left = results(out.path());
    assert!([expected(&first), expected(&second)].contains(&left));
}
