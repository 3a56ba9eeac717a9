//! The server: its routes, and its end.

use std::convert::Infallible;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::Arc;

use axum::Router;
use axum::body::Body;
use axum::extract::{DefaultBodyLimit, Path, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::middleware::from_fn_with_state;
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use futures_util::stream::unfold;
use tokio::net::TcpListener;

use super::charts::{Charts, Fidelity};
use super::guard::{Door, guard};
use super::job::Jobs;
use super::pages::Pages;
use super::reply::{Refusal, SavedFile, Start};
use super::task::{Meter, Task};
use super::{mode, page};
use crate::fit::Measurement;
use crate::scene::{MAX_SCENE_BYTES, Scene};
use crate::spectrum::SpectrumError;

/// Options of the server.
#[derive(Debug, Clone, Copy, Default)]
pub struct Options {
    /// Port on 127.0.0.1; 0 takes a free one.
    pub port: u16,
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

/// State common to all routes.
#[derive(Clone)]
pub struct Desk {
    start: Arc<Start>,
    jobs: Jobs,
    /// Queue of tasks, which take longer than a diagram; diagrams do not wait for it.
    tasks: Jobs,
    /// Queue of influences, which take about as long as a diagram. They do not wait for tasks, because
    /// waiting requests would occupy connections that diagrams need.
    influences: Jobs,
    charts: Arc<Charts>,
    pages: Arc<Pages>,
}

/// Serves the page of a scene until Ctrl-C, or until the last page is closed. `ready` is called with the
/// address.
///
/// # Errors
/// [`ExploreError`] when the port cannot be had or the system fails.
pub fn serve(
    scene: &Scene,
    options: Options,
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
        let desk = Desk {
            start: Arc::new(Start::new(scene)),
            jobs: Jobs::default(),
            tasks: Jobs::default(),
            influences: Jobs::default(),
            charts: Arc::default(),
            pages: Arc::default(),
        };
        let pages = desk.pages.clone();
        let app = router(desk, Door::new(port));
        ready(&format!("http://127.0.0.1:{port}/"));
        tokio::select! {
            served = async { axum::serve(listener, app).await } => served.map_err(ExploreError::from),
            _ = tokio::signal::ctrl_c() => Ok(()),
            () = pages.last_closed() => Ok(()),
        }
    });
    // Running computations are not waited for; they end with the process.
    runtime.shutdown_background();
    served
}

fn router(desk: Desk, door: Door) -> Router {
    Router::new()
        .route("/", get(|| async { page::file("index.html") }))
        .route(
            "/page/{name}",
            get(|Path(name): Path<String>| async move { page::file(&name) }),
        )
        .route("/start", get(start))
        .route("/alive", post(alive))
        .route("/leave", post(leave))
        .route("/read", post(read))
        .route("/measured/{name}", post(measured))
        .route("/jobs", get(jobs))
        .route("/progress", get(progress))
        .route("/chart/{fidelity}", post(chart))
        .route("/mode", post(mode_shape))
        .route("/task/{task}", post(task))
        .route("/influence", post(influence))
        .route("/save/{name}", post(save))
        .layer(DefaultBodyLimit::max(MAX_SCENE_BYTES as usize))
        .layer(from_fn_with_state(door, guard))
        .with_state(desk)
}

/// Sends the initial data of the page: scene, schema, colours.
async fn start(State(desk): State<Desk>) -> Response {
    json(StatusCode::OK, &*desk.start)
}

/// Sends the numbers of completed and cancelled computations, with which tests check that nothing outdated is
/// computed.
async fn jobs(State(desk): State<Desk>) -> Response {
    let [finished, stopped] = desk.jobs.counts();
    json(
        StatusCode::OK,
        &serde_json::json!({ "finished": finished, "stopped": stopped }),
    )
}

/// Header with the name of the page.
const PAGE: &str = "sawflutter-page";
/// Header with the identifier of the diagram that the page shows.
const CHART: &str = "sawflutter-chart";

fn text(headers: &HeaderMap, name: &str) -> String {
    let text = headers.get(name).and_then(|text| text.to_str().ok());
    text.unwrap_or_default().to_owned()
}

/// Sends the stage of the page's diagram that is being computed; null if there is none.
async fn progress(State(desk): State<Desk>, headers: HeaderMap) -> Response {
    let stage = desk.charts.under_way.stage(&text(&headers, PAGE));
    let stage = stage
        .map(|stage| serde_json::json!({ "what": stage.what, "done": stage.done, "of": stage.of, "eigenproblems": stage.eigenproblems }));
    json(StatusCode::OK, &stage)
}

/// Sends the diagram of a scene.
async fn chart(
    State(desk): State<Desk>,
    Path(fidelity): Path<Fidelity>,
    headers: HeaderMap,
    scene: String,
) -> Response {
    let charts = desk.charts.clone();
    let page = text(&headers, PAGE);
    let work = move || charts.chart(&page, &scene, fidelity);
    match desk.jobs.run(work).await {
        Some(Ok(text)) => json_text(StatusCode::OK, text),
        Some(Err(refusal)) => refused(&refusal),
        None => StatusCode::SERVICE_UNAVAILABLE.into_response(),
    }
}

/// Sends a mode of an earlier diagram.
async fn mode_shape(State(desk): State<Desk>, asked: String) -> Response {
    match mode::answer(&desk.charts, &asked) {
        Ok(found) => json(StatusCode::OK, &found),
        Err(refusal) => refused(&refusal),
    }
}

/// Sends progress and then the result, line by line; the task is cancelled when the connection closes.
async fn task(State(desk): State<Desk>, Path(task): Path<Task>, asked: String) -> Response {
    let (tell, told) = tokio::sync::mpsc::unbounded_channel();
    let job = async move {
        let work = move || task.run(&asked, &Meter::new(tell));
        last_line(desk.tasks.run(work).await)
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
    let kind = [(header::CONTENT_TYPE, "application/x-ndjson")];
    (kind, Body::from_stream(lines)).into_response()
}

fn last_line(done: Option<Result<String, Refusal>>) -> String {
    let refusal = match done {
        Some(Ok(answer)) => return answer,
        Some(Err(refusal)) => refusal,
        None => Refusal::of(&SpectrumError::Cancelled),
    };
    serde_json::json!({ "refusal": refusal }).to_string()
}

/// Sends the derivatives of an earlier diagram by the numbers of its scene.
async fn influence(State(desk): State<Desk>, asked: String) -> Response {
    let charts = desk.charts.clone();
    let work = move || charts.influence(&asked);
    match desk.influences.run(work).await {
        Some(Ok(found)) => json(StatusCode::OK, &found),
        Some(Err(refusal)) => refused(&refusal),
        None => StatusCode::SERVICE_UNAVAILABLE.into_response(),
    }
}

/// Sends a file as `sawflutter analyze` writes it for the scene.
async fn save(
    State(desk): State<Desk>,
    Path(name): Path<String>,
    headers: HeaderMap,
    scene: String,
) -> Response {
    let Some(kind) = SavedFile::named(&name) else {
        return StatusCode::NOT_FOUND.into_response();
    };
    let charts = desk.charts.clone();
    let chart = text(&headers, CHART).parse().unwrap_or_default();
    let work = move || charts.file(kind, chart, &scene);
    match desk.jobs.run(work).await {
        Some(Ok(content)) => ([(header::CONTENT_TYPE, kind.media_type())], content).into_response(),
        Some(Err(refusal)) => refused(&refusal),
        None => StatusCode::SERVICE_UNAVAILABLE.into_response(),
    }
}

fn refused(refusal: &Refusal) -> Response {
    json(StatusCode::UNPROCESSABLE_ENTITY, refusal)
}

fn json(status: StatusCode, value: &impl serde::Serialize) -> Response {
    match serde_json::to_string(value) {
        Ok(text) => json_text(status, text),
        Err(_) => StatusCode::INTERNAL_SERVER_ERROR.into_response(),
    }
}

fn json_text(status: StatusCode, text: String) -> Response {
    (status, [(header::CONTENT_TYPE, "application/json")], text).into_response()
}

/// Reads a scene as the command line does, with comments, and returns it as plain JSON.
async fn read(scene: String) -> Response {
    match Scene::from_json(&scene) {
        Ok(scene) => json(StatusCode::OK, scene.file()),
        Err(error) => refused(&error.into()),
    }
}

/// Reads a table of measured frequencies as `sawflutter fit` does, and returns it as a block of a scene.
async fn measured(Path(name): Path<String>, table: String) -> Response {
    match Measurement::from_csv(&name, &table) {
        Ok(measurement) => json(StatusCode::OK, &measurement.as_scene_block()),
        Err(error) => refused(&Refusal::of(&error)),
    }
}

/// Registers an open page by its name.
async fn alive(State(desk): State<Desk>, page: String) -> StatusCode {
    desk.pages.seen(page);
    StatusCode::NO_CONTENT
}

/// Removes a page that is being closed.
async fn leave(State(desk): State<Desk>, page: String) -> StatusCode {
    desk.pages.left(&page);
    desk.charts.forget(&page);
    StatusCode::NO_CONTENT
}
