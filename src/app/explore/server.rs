//! The server: its routes, and the conditions of its end.

use std::convert::Infallible;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};
use std::time::Instant;

use axum::Router;
use axum::body::Body;
use axum::extract::{Path, State};
use axum::http::{HeaderMap, StatusCode, Uri, header};
use axum::middleware::from_fn_with_state;
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use futures_util::stream::unfold;
use tokio::net::TcpListener;

use super::backend::{Answer, Backend, LINES, Question};
use super::connections;
use super::fields::Units;
use super::guard::{OwnHosts, guard};
use super::job::Jobs;
use super::opened_file::{OpenedFile, Unsaved};
use super::page;
use super::pages::Pages;
use super::refusal::Refusal;
use crate::model::scene::Scene;
use crate::modes::SpectrumError;

/// Options of the server.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Port on 127.0.0.1; 0 takes a free one.
    pub port: u16,
    /// File of the scene, to which the page saves on request.
    pub file: Option<PathBuf>,
}

/// Reason for which the page could not be served.
#[derive(Debug, thiserror::Error)]
pub enum ExploreError {
    /// The port is in use, or the system refuses it.
    #[error("cannot listen on 127.0.0.1:{port}; leave --port out to take a free one")]
    Listen {
        /// The requested port.
        port: u16,
        /// The error of the system.
        source: std::io::Error,
    },
    /// The system reported an error while the server ran.
    #[error("the server failed")]
    Serve(#[from] std::io::Error),
}

/// Milliseconds since the first call.
fn milliseconds() -> f64 {
    static BEGUN: OnceLock<Instant> = OnceLock::new();
    1e3 * BEGUN.get_or_init(Instant::now).elapsed().as_secs_f64()
}

/// State common to all routes.
#[derive(Clone)]
struct Server {
    backend: Arc<Backend>,
    jobs: Jobs,
    /// Queue of tasks, which take longer than a diagram; diagrams do not wait for it.
    tasks: Jobs,
    /// Queue of influences, which take about as long as a diagram. They do not wait for tasks, because
    /// waiting requests would occupy connections that diagrams need.
    influences: Jobs,
    /// Queue of critical speeds, which do not wait for a diagram that takes long.
    criticals: Jobs,
    pages: Arc<Pages>,
    file: Option<Arc<OpenedFile>>,
}

/// Serves the page of a scene until Ctrl-C, or until the last page is closed. `ready` is called with the
/// address.
///
/// # Errors
/// [`ExploreError`] if the port is not available or the server fails.
pub fn serve(
    scene: &Scene,
    options: &Options,
    ready: impl FnOnce(&str),
) -> Result<(), ExploreError> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    let served = runtime.block_on(async {
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, options.port));
        let refused = |source| ExploreError::Listen {
            port: options.port,
            source,
        };
        let listener = TcpListener::bind(address).await.map_err(refused)?;
        let port = listener.local_addr()?.port();
        let file = options.file.as_deref().and_then(OpenedFile::new);
        let note = file.as_ref().map(OpenedFile::note);
        let server = Server {
            backend: Arc::new(Backend::new(scene, milliseconds).with_file(note)),
            jobs: Jobs::default(),
            tasks: Jobs::default(),
            influences: Jobs::default(),
            criticals: Jobs::default(),
            pages: Arc::default(),
            file: file.map(Arc::new),
        };
        let pages = server.pages.clone();
        let app = router(server, OwnHosts::new(port));
        ready(&format!("http://127.0.0.1:{port}/"));
        tokio::select! {
            () = connections::serve(listener, app, connections::PATIENCE) => (),
            _ = tokio::signal::ctrl_c() => (),
            () = pages.last_closed() => (),
        }
        Ok(())
    });
    // Running computations are not waited for; they end with the process.
    runtime.shutdown_background();
    served
}

fn router(server: Server, hosts: OwnHosts) -> Router {
    let waiting_in = |queue: Queue| {
        move |State(server): State<Server>, uri: Uri, headers: HeaderMap, body: String| {
            asked(server, queue, uri, headers, body)
        }
    };
    let sending_lines = |queue: Queue| {
        move |State(server): State<Server>, uri: Uri, headers: HeaderMap, body: String| async move {
            line_by_line(&server, queue, question(&uri, &headers, body))
        }
    };
    let at_once = waiting_in(Queue::None);
    let saved = waiting_in(Queue::Charts);
    let weighed = waiting_in(Queue::Influences);
    let ahead = waiting_in(Queue::Criticals);
    Router::new()
        .route("/", get(|| async { page::file("index.html") }))
        .route(
            "/page/{name}",
            get(|Path(name): Path<String>| async move { page::file(&name) }),
        )
        .route("/start", get(at_once))
        .route("/read", post(at_once))
        .route("/measured", post(at_once))
        .route("/part", post(at_once))
        .route("/numbers", post(at_once))
        .route("/mode", post(at_once))
        .route("/chart/{fidelity}", post(sending_lines(Queue::Charts)))
        .route("/critical", post(ahead))
        .route("/save/{name}", post(saved))
        .route("/influence", post(weighed))
        .route("/task/{task}", post(sending_lines(Queue::Tasks)))
        .route("/file", post(save_to_file))
        .route("/alive", post(alive))
        .route("/leave", post(leave))
        .route("/jobs", get(jobs))
        .route("/progress", get(progress))
        .layer(from_fn_with_state(hosts, guard))
        .with_state(server)
}

/// Sends the numbers of completed and cancelled computations, with which tests check that nothing outdated is
/// computed.
async fn jobs(State(server): State<Server>) -> Response {
    let [finished, stopped] = server.jobs.counts();
    sent(Answer::json(
        &serde_json::json!({ "finished": finished, "stopped": stopped }),
    ))
}

/// Header with the name of the page.
const PAGE: &str = "sawflutter-page";
/// Header with the identifier of the diagram that the page shows.
const CHART: &str = "sawflutter-chart";
/// Header with the units of the form.
const UNITS: &str = "sawflutter-units";

fn text(headers: &HeaderMap, name: &str) -> String {
    let text = headers.get(name).and_then(|text| text.to_str().ok());
    text.unwrap_or_default().to_owned()
}

/// Sends the stage of the page's diagram that is being computed; null if there is none.
async fn progress(State(server): State<Server>, headers: HeaderMap) -> Response {
    let stage = server.backend.charts.under_way.stage(&text(&headers, PAGE));
    sent(Answer::json(&stage))
}

/// Queues of requests, which do not wait for requests in another queue.
#[derive(Clone, Copy)]
enum Queue {
    /// Diagrams and files.
    Charts,
    Tasks,
    Influences,
    Criticals,
    /// Requests that take no time and are answered at once.
    None,
}

impl Server {
    /// The computations of a queue; `None` for requests that are answered at once.
    fn jobs_of(&self, queue: Queue) -> Option<&Jobs> {
        match queue {
            Queue::Charts => Some(&self.jobs),
            Queue::Tasks => Some(&self.tasks),
            Queue::Influences => Some(&self.influences),
            Queue::Criticals => Some(&self.criticals),
            Queue::None => None,
        }
    }
}

/// Sends the answer to a request.
async fn asked(
    server: Server,
    queue: Queue,
    uri: Uri,
    headers: HeaderMap,
    body: String,
) -> Response {
    let question = question(&uri, &headers, body);
    let backend = server.backend.clone();
    let work = move || backend.answer(&question, |_| ());
    let answer = match server.jobs_of(queue) {
        Some(jobs) => jobs.run(work).await,
        None => Some(work()),
    };
    answer.map_or_else(|| StatusCode::SERVICE_UNAVAILABLE.into_response(), sent)
}

fn question(uri: &Uri, headers: &HeaderMap, body: String) -> Question {
    Question {
        path: uri.path().trim_start_matches('/').to_owned(),
        page: text(headers, PAGE),
        chart: text(headers, CHART),
        units: units(headers),
        body,
    }
}

fn units(headers: &HeaderMap) -> Units {
    match text(headers, UNITS).as_str() {
        "inches" => Units::Inches,
        _ => Units::Metric,
    }
}

fn sent(answer: Answer) -> Response {
    let status = StatusCode::from_u16(answer.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
    let kind = [(header::CONTENT_TYPE, answer.media_type)];
    (status, kind, answer.content).into_response()
}

/// Sends early results of a diagram, or the progress of a task, and then the result, line by line. The
/// computation is cancelled when the connection closes.
fn line_by_line(server: &Server, queue: Queue, question: Question) -> Response {
    if !question.is_answered_in_lines() {
        return StatusCode::BAD_REQUEST.into_response();
    }
    let backend = server.backend.clone();
    let jobs = server.jobs_of(queue).cloned().unwrap_or_default();
    let (tell, told) = tokio::sync::mpsc::unbounded_channel();
    let job = async move {
        // An error of sending is ignored, because the receiver may be closed already.
        let work = move || backend.answer(&question, move |line| drop(tell.send(line)));
        let done = jobs.run(work).await.map(|answer| answer.content);
        done.and_then(|line| String::from_utf8(line).ok())
            .unwrap_or_else(cancelled)
    };
    let lines = unfold((Some(Box::pin(job)), told), |(job, mut told)| async move {
        let mut job = job?;
        let (line, rest) = tokio::select! {
            biased;
            Some(line) = told.recv() => (line, Some(job)),
            line = &mut job => (line, None),
        };
        Some((Ok::<_, Infallible>(line + "\n"), (rest, told)))
    });
    let kind = [(header::CONTENT_TYPE, LINES)];
    (kind, Body::from_stream(lines)).into_response()
}

fn cancelled() -> String {
    serde_json::json!({ "refusal": Refusal::of(&SpectrumError::Cancelled) }).to_string()
}

/// Saves the scene to the file that the program was started with. If another program has changed the file, its content
/// is sent.
async fn save_to_file(State(server): State<Server>, headers: HeaderMap, body: String) -> Response {
    let Some(file) = &server.file else {
        return StatusCode::NOT_FOUND.into_response();
    };
    match file.save(&body) {
        Ok(()) => StatusCode::NO_CONTENT.into_response(),
        Err(Unsaved::Changed(text)) => (StatusCode::CONFLICT, text).into_response(),
        Err(Unsaved::Refused(refusal)) => {
            sent(Answer::refused(&refusal.in_field(&body, units(&headers))))
        }
    }
}

/// Registers an open page by its name.
async fn alive(State(server): State<Server>, page: String) -> StatusCode {
    server.pages.seen(page);
    StatusCode::NO_CONTENT
}

/// Removes a page that is being closed.
async fn leave(State(server): State<Server>, page: String) -> StatusCode {
    server.pages.left(&page);
    server.backend.charts.forget(&page);
    StatusCode::NO_CONTENT
}
