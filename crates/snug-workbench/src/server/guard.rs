//! Who may connect: pages of this workbench, from this machine. Another site's page in the same browser may not.

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

/// The names by which this machine calls the workbench.
#[derive(Debug, Clone)]
pub(crate) struct Guard {
    hosts: [String; 2],
}

/// Port that an address may leave out.
const HTTP: u16 = 80;

impl Guard {
    pub fn at(port: u16) -> Self {
        let named = |host: &str| match port {
            HTTP => host.to_owned(),
            port => format!("{host}:{port}"),
        };
        Self {
            hosts: [named("127.0.0.1"), named("localhost")],
        }
    }

    /// Why a request is refused, in a sentence; `None` where it is not.
    pub fn refusal(&self, headers: &HeaderMap) -> Option<&'static str> {
        let text = |name| {
            headers
                .get(name)
                .map(|value: &HeaderValue| value.to_str().unwrap_or(""))
        };
        let is_ours = |host: &str| self.hosts.iter().any(|known| known == host);
        let host = text(header::HOST).unwrap_or("");
        if !is_ours(host) {
            return Some(
                "This workbench answers at 127.0.0.1 and localhost only: another name that leads to this machine is refused.",
            );
        }
        let origin = text(header::ORIGIN);
        if origin.is_some_and(|origin| origin.strip_prefix("http://") != Some(host)) {
            return Some(
                "Another site's page asked this workbench for something: that is refused.",
            );
        }
        // Typed into the address bar or opened from outside a browser, it comes from no page at all.
        match text(header::HeaderName::from_static("sec-fetch-site")) {
            None | Some("same-origin" | "none") => None,
            Some(_) => Some(
                "Another site's page led here: that is refused. Copy the link into the address bar to open it.",
            ),
        }
    }
}

/// What a page may load and who may frame it: nothing and nobody but itself.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self'; img-src data:; \
                      base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Refuses what the guard refuses, before anything is done.
pub(crate) async fn guarded(State(guard): State<Guard>, request: Request, next: Next) -> Response {
    if let Some(sentence) = guard.refusal(request.headers()) {
        return (StatusCode::FORBIDDEN, sentence).into_response();
    }
    let mut response = next.run(request).await;
    let headers = response.headers_mut();
    headers.insert(
        header::CONTENT_SECURITY_POLICY,
        HeaderValue::from_static(POLICY),
    );
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    headers.insert(
        header::X_CONTENT_TYPE_OPTIONS,
        HeaderValue::from_static("nosniff"),
    );
    headers.insert(
        header::REFERRER_POLICY,
        HeaderValue::from_static("no-referrer"),
    );
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(pairs: &[(&'static str, &'static str)]) -> bool {
        let mut headers = HeaderMap::new();
        for (name, value) in pairs {
            headers.insert(*name, HeaderValue::from_static(value));
        }
        Guard::at(7000).refusal(&headers).is_some()
    }

    #[test]
    fn only_this_machine_s_names_are_answered() {
        assert!(!refused(&[("host", "127.0.0.1:7000")]));
        assert!(!refused(&[("host", "localhost:7000")]));
        for host in [
            "127.0.0.1",
            "localhost:7001",
            "evil.example:7000",
            "127.0.0.1:7000.evil.example",
        ] {
            assert!(refused(&[("host", host)]), "{host}");
        }
        assert!(refused(&[]));
    }

    #[test]
    fn another_site_s_page_is_refused() {
        let host = ("host", "localhost:7000");
        assert!(!refused(&[host, ("origin", "http://localhost:7000")]));
        for origin in [
            "http://evil.example",
            "null",
            "https://localhost:7000",
            "http://localhost:7001",
            "http://127.0.0.1:7000",
        ] {
            assert!(refused(&[host, ("origin", origin)]), "{origin}");
        }
        assert!(!refused(&[host, ("sec-fetch-site", "same-origin")]));
        assert!(!refused(&[host, ("sec-fetch-site", "none")]));
        for site in ["cross-site", "same-site"] {
            assert!(refused(&[host, ("sec-fetch-site", site)]), "{site}");
        }
    }
}
