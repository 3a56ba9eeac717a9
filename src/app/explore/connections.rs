//! Connections of the server. One whose request does not arrive in time is closed, so that no client holds it half-open.

use std::time::Duration;

use axum::Router;
use axum::body::{Body, to_bytes};
use axum::extract::{Request, State};
use axum::http::StatusCode;
use axum::middleware::{Next, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::TcpListener;
use tokio::time::{sleep, timeout};

use crate::model::scene::MAX_SCENE_BYTES;

/// Longest time in which the head of a request arrives, and then its content.
pub const PATIENCE: Duration = Duration::from_secs(30);
/// Time until the next attempt after the system refused a connection, for example because too many files are open.
const AGAIN: Duration = Duration::from_millis(500);

/// Serves an application to all connections of a listener.
pub async fn serve(listener: TcpListener, app: Router, patience: Duration) {
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(patience);
    let whole = app.layer(from_fn_with_state(patience, whole));
    loop {
        let Ok((stream, _)) = listener.accept().await else {
            sleep(AGAIN).await;
            continue;
        };
        let service = TowerToHyperService::new(whole.clone());
        let connection = http.serve_connection(TokioIo::new(stream), service);
        // The client sees an error of its connection.
        tokio::spawn(async { drop(connection.await) });
    }
}

/// Waits for the content of a request, which must arrive within a time.
async fn whole(State(patience): State<Duration>, request: Request, next: Next) -> Response {
    let (head, body) = request.into_parts();
    match timeout(patience, to_bytes(body, MAX_SCENE_BYTES as usize)).await {
        Ok(Ok(content)) => {
            next.run(Request::from_parts(head, Body::from(content)))
                .await
        }
        Ok(Err(_)) => StatusCode::PAYLOAD_TOO_LARGE.into_response(),
        Err(_) => StatusCode::REQUEST_TIMEOUT.into_response(),
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Read, Write};
    use std::net::{Ipv4Addr, TcpStream};

    use tokio::runtime::Builder;
    use tokio::task::spawn_blocking;

    use super::*;

    /// Sends the beginning of a request, and returns what arrives until the server closes the connection.
    fn answer_to(beginning: &'static str) -> String {
        let runtime = Builder::new_current_thread().enable_all().build().unwrap();
        runtime.block_on(async {
            let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await.unwrap();
            let address = listener.local_addr().unwrap();
            let client = spawn_blocking(move || {
                let mut stream = TcpStream::connect(address).unwrap();
                let patience = Some(Duration::from_secs(60));
                stream.set_read_timeout(patience).unwrap();
                stream.write_all(beginning.as_bytes()).unwrap();
                let mut text = String::new();
                stream.read_to_string(&mut text).unwrap();
                text
            });
            tokio::select! {
                () = serve(listener, Router::new(), Duration::from_millis(100)) => unreachable!(),
                text = client => text.unwrap(),
            }
        })
    }

    #[test]
    fn a_request_that_does_not_arrive_is_not_waited_for() {
        for head in ["", "GET / HTTP/1.1\r\nHost: 127"] {
            let text = answer_to(head);
            assert!(!text.contains("200"), "{head}: {text}");
        }
        let text = answer_to("POST /read HTTP/1.1\r\nHost: a\r\nContent-Length: 9\r\n\r\n{");
        assert!(text.starts_with("HTTP/1.1 408"), "{text}");
    }
}
