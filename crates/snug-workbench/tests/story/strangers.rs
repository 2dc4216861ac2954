//! Who may not connect: other names of this machine, and other sites' pages in the same browser.

use crate::browser::{asked, get, workbench};

#[test]
fn only_the_workbench_s_own_page_is_answered() {
    let port = workbench();
    let (status, page) = get(port, "/");
    assert!(status == 200 && page.contains("stretch reflex"));
    assert!(!page.contains("src=\"http") && !page.contains("href=\"http"));
    let with = |headers: &str| {
        let request = format!("GET / HTTP/1.1\r\nConnection: close\r\n{headers}\r\n");
        asked(port, &request)
    };
    let host = format!("Host: localhost:{port}\r\n");
    assert_eq!(with(&host).0, 200);
    for headers in [
        format!("Host: evil.example:{port}\r\n"),
        format!("{host}Origin: http://evil.example\r\n"),
        format!("{host}Sec-Fetch-Site: cross-site\r\n"),
    ] {
        let (status, sentence) = with(&headers);
        assert_eq!(status, 403, "{headers}");
        assert!(sentence.contains("refused"), "{sentence}");
    }
}
