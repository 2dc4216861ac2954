//! What the server answers to.

use crate::bench::{Bench, Reading};
use crate::changes::{Changes, EffectSet};
use crate::error::WorkbenchError;
use crate::{page, save, told};
use axum::extract::{Json, Query, State};
use axum::http::StatusCode;
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Router, middleware};
use serde::Deserialize;
use serde_json::{Value, json};
use std::convert::Infallible;
use std::sync::Arc;
use tokio_stream::StreamExt;
use tokio_stream::wrappers::{BroadcastStream, WatchStream};

use crate::guard::{Guard, guarded};

/// All of it, behind the guard.
pub(crate) fn router(bench: Arc<Bench>, guard: Guard) -> Router {
    Router::new()
        .route("/", get(start))
        .route("/api/reading", get(reading))
        .route("/api/events", get(events))
        .route("/api/change", post(change))
        .route("/api/tightening", get(tightening))
        .route("/api/save", post(save_study))
        .with_state(bench)
        .layer(middleware::from_fn_with_state(guard, guarded))
}

impl IntoResponse for WorkbenchError {
    fn into_response(self) -> Response {
        let status = match &self {
            Self::StillReading => StatusCode::SERVICE_UNAVAILABLE,
            Self::NotFitted | Self::NoTightening { .. } => StatusCode::NOT_FOUND,
            Self::Study(error) if error.is_bad_argument() => StatusCode::BAD_REQUEST,
            _ => StatusCode::INTERNAL_SERVER_ERROR,
        };
        let body = json!({ "sentence": self.to_string() });
        (status, Json(body)).into_response()
    }
}

async fn start(State(bench): State<Arc<Bench>>) -> Html<String> {
    let reading = bench.reading().borrow().clone();
    Html(match reading {
        Reading::Done(campaign) => {
            let page = page::working(&campaign).into_string();
            snug_report::markup(&page, campaign.prepared.vocabulary)
        }
        Reading::UnderWay(sentence) | Reading::Failed(sentence) => {
            page::reading(&sentence).into_string()
        }
    })
}

/// An event as the browser takes it.
fn event(value: &Value) -> Result<Event, Infallible> {
    Ok(Event::default().data(value.to_string()))
}

async fn reading(State(bench): State<Arc<Bench>>) -> impl IntoResponse {
    let told = WatchStream::new(bench.reading()).map(|reading| {
        event(&match reading {
            Reading::UnderWay(sentence) => json!({ "kind": "reading", "sentence": sentence }),
            Reading::Done(_) => json!({ "kind": "ready" }),
            Reading::Failed(sentence) => json!({ "kind": "failed", "sentence": sentence }),
        })
    });
    Sse::new(told).keep_alive(KeepAlive::default())
}

/// Which page, and which model it shows.
#[derive(Deserialize)]
struct Attendance {
    session: String,
    #[serde(default)]
    effects: String,
}

async fn events(
    State(bench): State<Arc<Bench>>,
    Query(page): Query<Attendance>,
) -> Result<Response, WorkbenchError> {
    let effects = EffectSet::from_address(&page.effects);
    let listener = bench.attend(&page.session, effects)?;
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
    Choose { effects: String },
    Undo,
    Redo,
}

#[derive(Deserialize)]
struct Wished {
    session: String,
    #[serde(flatten)]
    wish: Wish,
}

async fn change(
    State(bench): State<Arc<Bench>>,
    Json(wished): Json<Wished>,
) -> Result<StatusCode, WorkbenchError> {
    let wish: Box<dyn FnOnce(&mut Changes) + Send> = match wished.wish {
        Wish::Undo => Box::new(Changes::undo),
        Wish::Redo => Box::new(Changes::redo),
        Wish::Choose { effects } => {
            let effects = EffectSet::from_address(&effects);
            bench.campaign()?.prepared.named(effects.names())?;
            Box::new(move |changes| changes.choose(effects))
        }
    };
    bench.change(&wished.session, wish)?;
    Ok(StatusCode::ACCEPTED)
}

/// Which tightening, under which models.
#[derive(Deserialize)]
struct Wanted {
    number: usize,
    #[serde(default)]
    effects: String,
    /// The model before; the one to begin with where it is not said.
    before: Option<String>,
}

async fn tightening(
    State(bench): State<Arc<Bench>>,
    Query(wanted): Query<Wanted>,
) -> Result<Json<Value>, WorkbenchError> {
    let work = move || {
        let campaign = bench.campaign()?;
        let member = campaign.member(wanted.number)?;
        let fit = |effects: &EffectSet| bench.fitted(effects).ok_or(WorkbenchError::NotFitted);
        let base_set = campaign.base_set();
        let now_set = EffectSet::from_address(&wanted.effects);
        let before_set = wanted.before.as_deref().map(EffectSet::from_address);
        let before_set = before_set.unwrap_or_else(|| base_set.clone());
        let live = &campaign.prepared.live;
        let (before, now) = (fit(&before_set)?, fit(&now_set)?);
        let seen_before = live.tightening(&before, member)?;
        let seen_now = live.tightening(&now, member)?;
        let seen_base = match (before_set == base_set, now_set == base_set) {
            (_, true) => None,
            (true, false) => Some(seen_before.clone()),
            (false, false) => Some(live.tightening(&campaign.base, member)?),
        };
        let mut answer = campaign
            .compared(member, seen_base.as_ref(), &seen_now)
            .json();
        answer["told"] = told::tightening(
            &campaign,
            member,
            [(&before, &seen_before), (&now, &seen_now)],
        );
        Ok(Json(answer))
    };
    tokio::task::spawn_blocking(work)
        .await
        .unwrap_or(Err(WorkbenchError::NotFitted))
}

/// Which model is saved.
#[derive(Deserialize)]
struct Kept {
    #[serde(default)]
    effects: String,
}

async fn save_study(
    State(bench): State<Arc<Bench>>,
    Json(kept): Json<Kept>,
) -> Result<Json<Value>, WorkbenchError> {
    let effects = EffectSet::from_address(&kept.effects);
    let campaign = bench.campaign()?;
    campaign.prepared.named(effects.names())?;
    let path = save::save(&bench, &effects)?;
    let sentence = format!(
        "Saved as {}. The command cargo xtask run --study with it fits every tightening with this model.",
        path.display()
    );
    Ok(Json(json!({ "sentence": sentence })))
}
