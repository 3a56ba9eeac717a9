//! Access control: only requests of pages that this server has served, on this computer, are answered.

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

/// Host names of the server, with its port.
#[derive(Debug, Clone)]
pub struct OwnHosts {
    hosts: [String; 2],
}

impl OwnHosts {
    /// Creates the host names with this port.
    pub fn new(port: u16) -> Self {
        OwnHosts {
            hosts: ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}")),
        }
    }

    /// Returns the reason for which a request is refused, if any. A foreign page may have a host name that points to
    /// this computer, which is visible in `Host`; or it may send a request here, which is visible in `Origin`.
    pub fn refusal(&self, headers: &HeaderMap) -> Option<String> {
        let own = |host: &str| self.hosts.iter().any(|own| own == host);
        let host = text(headers, header::HOST);
        if !host.is_some_and(own) {
            return Some(format!(
                "Host must be {1} (it is {0:?}); open the address that the program has printed",
                host.unwrap_or_default(),
                self.hosts.join(" or ")
            ));
        }
        let origin = headers.get(header::ORIGIN)?;
        let ours = |origin: &str| origin.strip_prefix("http://").is_some_and(own);
        if origin.to_str().is_ok_and(ours) {
            None
        } else {
            Some(format!(
                "Origin is {origin:?}, but only pages of this program may ask"
            ))
        }
    }
}

fn text(headers: &HeaderMap, name: header::HeaderName) -> Option<&str> {
    headers.get(name)?.to_str().ok()
}

/// The page loads everything from this server, and injected scripts do not run.
const POLICY: &str = include_str!("page/policy.txt").trim_ascii();

/// Refuses foreign requests and sends the content policy.
pub async fn guard(State(hosts): State<OwnHosts>, request: Request, next: Next) -> Response {
    let mut response = match hosts.refusal(request.headers()) {
        Some(reason) => (StatusCode::FORBIDDEN, reason).into_response(),
        None => next.run(request).await,
    };
    let headers = response.headers_mut();
    for (name, value) in [
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CACHE_CONTROL, "no-store"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    headers.insert(
        "cross-origin-resource-policy",
        HeaderValue::from_static("same-origin"),
    );
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(headers: &[(header::HeaderName, &str)]) -> Option<String> {
        let headers = headers
            .iter()
            .map(|(name, value)| (name.clone(), HeaderValue::from_str(value).unwrap()));
        OwnHosts::new(4711).refusal(&headers.collect())
    }

    #[test]
    fn only_the_own_page_is_let_in() {
        use header::{HOST, ORIGIN};
        let own = (HOST, "127.0.0.1:4711");
        assert_eq!(refusal(std::slice::from_ref(&own)), None);
        assert_eq!(refusal(&[(HOST, "localhost:4711")]), None);
        let page = (ORIGIN, "http://127.0.0.1:4711");
        assert_eq!(refusal(&[own.clone(), page.clone()]), None);
        for stranger in ["example.com:4711", "127.0.0.1", "127.0.0.1:80", ""] {
            let reason = refusal(&[(HOST, stranger), page.clone()]).unwrap();
            assert!(reason.contains("Host"), "{reason}");
        }
        assert!(refusal(&[]).unwrap().contains("Host"));
        for stranger in ["http://example.com", "null", "https://127.0.0.1:4711", ""] {
            let reason = refusal(&[own.clone(), (ORIGIN, stranger)]).unwrap();
            assert!(reason.contains("Origin"), "{reason}");
        }
    }
}
