//! What the server answers to.

use crate::bench::look::Look;
use crate::bench::{Bench, Reading};
use crate::bench::{results, save};
use crate::campaign::focus::Closer;
use crate::changes::EffectSet;
use crate::error::WorkbenchError;
use crate::page;
use crate::session::Session;
use axum::extract::{Json, Path, Query, RawQuery};
use axum::http::{StatusCode, header};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Router, middleware};
use serde::Deserialize;
use serde_json::{Value, json};
use snug_campaign::words::program::program;
use std::convert::Infallible;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use tokio_stream::StreamExt;
use tokio_stream::wrappers::{BroadcastStream, WatchStream};

use crate::server::benches::{At, Benches, OF_A_STRETCH};
use crate::server::guard::{Guard, guarded};

/// All of it, behind the guard.
pub(crate) fn router(bench: Arc<Bench>, guard: Guard) -> Router {
    Router::new()
        .merge(pages())
        .nest(OF_A_STRETCH, pages())
        .with_state(Arc::new(Benches::on(bench)))
        .layer(middleware::from_fn_with_state(guard, guarded))
}

/// What there is on whole windows, and once more on every stretch.
fn pages() -> Router<Arc<Benches>> {
    Router::new()
        .route("/", get(start))
        .route("/api/reading", get(reading))
        .route("/api/events", get(events))
        .route("/api/change", post(change))
        .route("/api/tightening", get(tightening))
        .route("/api/force", get(what_is_left))
        .route("/api/save", post(save_study))
        .route("/api/results", post(make_results))
        .route("/results/{number}/{name}", get(result_file))
}

impl WorkbenchError {
    fn status(&self) -> StatusCode {
        match self {
            Self::StillReading | Self::ManyStretches { .. } => StatusCode::SERVICE_UNAVAILABLE,
            Self::NotFitted | Self::NoTightening { .. } | Self::NoResults => StatusCode::NOT_FOUND,
            Self::NoGroup { .. }
            | Self::NoStretch { .. }
            | Self::NoCell { .. }
            | Self::StretchAndCell
            | Self::NoNumbers { .. } => StatusCode::BAD_REQUEST,
            Self::Study(error) if error.is_bad_argument() => StatusCode::BAD_REQUEST,
            _ => StatusCode::INTERNAL_SERVER_ERROR,
        }
    }
}

impl IntoResponse for WorkbenchError {
    fn into_response(self) -> Response {
        let body = json!({ "sentence": self.to_string() });
        (self.status(), Json(body)).into_response()
    }
}

async fn start(at: Result<At, WorkbenchError>, RawQuery(shown): RawQuery) -> Response {
    let whole = format!("/?{}", shown.unwrap_or_default());
    let At { bench, root } = match at {
        Ok(at) => at,
        Err(error) => {
            let page = page::failed(&error.to_string(), Some(&whole));
            return (error.status(), Html(page.into_string())).into_response();
        }
    };
    let reading = bench.reading().borrow().clone();
    let page = match reading {
        Reading::Done(campaign) => {
            let page = page::working(&campaign, &root).into_string();
            snug_report::markup(&page, campaign.prepared.vocabulary)
        }
        Reading::UnderWay(sentence) => page::reading(&sentence, &root).into_string(),
        Reading::Failed(sentence) => {
            page::failed(&sentence, Some(&*whole).filter(|_| !root.is_empty())).into_string()
        }
    };
    Html(page).into_response()
}

/// An event as the browser takes it.
fn event(value: &Value) -> Result<Event, Infallible> {
    Ok(Event::default().data(value.to_string()))
}

async fn reading(At { bench, .. }: At) -> impl IntoResponse {
    let told = WatchStream::new(bench.reading()).map(|reading| {
        event(&match reading {
            Reading::UnderWay(sentence) => json!({ "kind": "reading", "sentence": sentence }),
            Reading::Done(_) => json!({ "kind": "ready" }),
            Reading::Failed(sentence) => json!({ "kind": "failed", "sentence": sentence }),
        })
    });
    Sse::new(told).keep_alive(KeepAlive::default())
}

/// Which page, and what it shows.
#[derive(Deserialize)]
struct Attendance {
    session: String,
    #[serde(default)]
    effects: String,
    #[serde(default)]
    group: String,
    from_s: Option<f64>,
    to_s: Option<f64>,
    #[serde(default)]
    cell: String,
}

async fn events(
    At { bench, .. }: At,
    Query(page): Query<Attendance>,
) -> Result<Response, WorkbenchError> {
    let effects = EffectSet::from_address(&page.effects);
    let closer = Closer {
        group: page.group,
        from_s: page.from_s,
        to_s: page.to_s,
        cell: page.cell,
    };
    let listener = bench.attend(&page.session, effects, closer)?;
    // Whoever lagged behind is cut off, comes again, and is told the whole state.
    let told = BroadcastStream::new(listener)
        .take_while(Result::is_ok)
        .filter_map(Result::ok)
        .map(|value| event(&value));
    let told = Sse::new(told).keep_alive(KeepAlive::default());
    Ok(told.into_response())
}

/// What a page asks for.
#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Wish {
    Choose {
        effects: String,
    },
    Undo,
    Redo,
    /// Back to one of the models so far, from 0.
    Back {
        rung: usize,
    },
    /// A closer look, or one at everything again.
    Closer(Closer),
    /// A fit of the present model from numbers that were set by hand.
    FitFrom {
        number: usize,
        values: String,
    },
}

#[derive(Deserialize)]
struct Wished {
    session: String,
    #[serde(flatten)]
    wish: Wish,
}

async fn change(
    At { bench, .. }: At,
    Json(wished): Json<Wished>,
) -> Result<StatusCode, WorkbenchError> {
    let wish: Box<dyn FnOnce(&mut Session) + Send> = match wished.wish {
        Wish::Undo => Box::new(|known| known.changes.undo()),
        Wish::Redo => Box::new(|known| known.changes.redo()),
        Wish::Back { rung } => Box::new(move |known| known.changes.back_to(rung)),
        Wish::Choose { effects } => {
            let effects = EffectSet::from_address(&effects);
            bench.campaign()?.prepared.named(effects.names())?;
            Box::new(move |known| known.changes.choose(effects))
        }
        Wish::Closer(closer) => {
            closer.focus(&*bench.campaign()?)?;
            Box::new(move |known| known.closer = closer)
        }
        Wish::FitFrom { number, values } => {
            fit_from(bench, wished.session, number, values).await?;
            return Ok(StatusCode::ACCEPTED);
        }
    };
    bench.change(&wished.session, wish)?;
    Ok(StatusCode::ACCEPTED)
}

async fn fit_from(
    bench: Arc<Bench>,
    session: String,
    number: usize,
    values: String,
) -> Result<(), WorkbenchError> {
    aside(move || {
        let member = bench.campaign()?.member(number)?;
        let effects = bench
            .present_set(&session)
            .ok_or(WorkbenchError::NotFitted)?;
        let values = bench.set_by_hand(&effects, member, &values)?;
        bench.fit_from(&session, member, values)
    })
    .await
}

/// Does what takes a while where it keeps nobody waiting.
async fn aside<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, WorkbenchError> + Send + 'static,
) -> Result<T, WorkbenchError> {
    (tokio::task::spawn_blocking(work).await).unwrap_or(Err(WorkbenchError::NotFitted))
}

async fn tightening(
    At { bench, .. }: At,
    Query(look): Query<Look>,
) -> Result<Json<Value>, WorkbenchError> {
    aside(move || bench.look(&look).map(Json)).await
}

/// Which model.
#[derive(Deserialize)]
struct Which {
    #[serde(default)]
    effects: String,
}

/// Which model, and which to hold it against.
#[derive(Deserialize)]
struct Between {
    #[serde(default)]
    effects: String,
    before: Option<String>,
}

async fn what_is_left(
    At { bench, .. }: At,
    Query(between): Query<Between>,
) -> Result<Html<String>, WorkbenchError> {
    aside(move || {
        let campaign = bench.campaign()?;
        let left = |effects: &str| {
            let effects = EffectSet::from_address(effects);
            let fit = bench.fitted_now(&campaign, &effects, &AtomicBool::new(false))?;
            Ok::<_, WorkbenchError>(campaign.prepared.live.what_is_left(&fit)?)
        };
        let now = left(&between.effects)?;
        let before = between.before.as_deref().map(left).transpose()?;
        let drawn =
            snug_report::viewer::what_is_left(&now, before.as_ref(), &campaign.prepared.units)
                .into_string();
        Ok(Html(snug_report::markup(
            &drawn,
            campaign.prepared.vocabulary,
        )))
    })
    .await
}

async fn make_results(
    At { bench, .. }: At,
    Json(which): Json<Which>,
) -> Result<Json<Value>, WorkbenchError> {
    let effects = EffectSet::from_address(&which.effects);
    let number = aside(move || bench.make_results(&effects)).await?;
    let links: Vec<String> = (results::FILES.iter())
        .map(|(name, _)| format!("/results/{number}/{name}"))
        .collect();
    Ok(Json(json!({ "links": links })))
}

/// A file of results, by the number of those.
#[derive(Deserialize)]
struct ResultFile {
    number: usize,
    name: String,
}

async fn result_file(
    At { bench, .. }: At,
    Path(ResultFile { number, name }): Path<ResultFile>,
) -> Result<Response, WorkbenchError> {
    aside(move || {
        let (path, kind) = bench.result_file(number, &name)?;
        let bytes = std::fs::read(path).map_err(|source| WorkbenchError::Results { source })?;
        Ok(([(header::CONTENT_TYPE, kind)], bytes).into_response())
    })
    .await
}

async fn save_study(
    At { bench, .. }: At,
    Json(kept): Json<Which>,
) -> Result<Json<Value>, WorkbenchError> {
    let effects = EffectSet::from_address(&kept.effects);
    let campaign = bench.campaign()?;
    campaign.prepared.named(effects.names())?;
    let path = save::save(&bench, &effects)?;
    let sentence = format!(
        "Saved as {}. The command {} run --study with it fits every tightening with this model.",
        path.display(),
        program()
    );
    Ok(Json(json!({ "sentence": sentence })))
}
