//! An S3-compatible store over a folder, whose top folders are buckets, and which answers as a test wants it to.

use crate::plant::Plant;
use hyper::body::Incoming;
use hyper::service::{Service, service_fn};
use hyper::{Method, Request, Response, StatusCode};
use hyper_util::rt::TokioIo;
use s3s::auth::SimpleAuth;
use s3s::service::{S3Service, S3ServiceBuilder};
use s3s_fs::FileSystem;
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use tokio::net::TcpListener;

/// How a request is answered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Answer {
    Right,
    /// 503, as a store says that is asked too much.
    Busy,
    Late(Duration),
    Never,
}

/// By the request's number, method and path.
type Answers = Arc<dyn Fn(usize, &Method, &str) -> Answer + Send + Sync>;

/// A store that ends with the test.
pub struct StoreServer {
    port: u16,
    answers: Arc<Mutex<Answers>>,
    asked: Arc<AtomicUsize>,
}

impl StoreServer {
    /// A store whose buckets are the folders of a plant.
    pub async fn over(plant: &Plant, buckets: &[&str]) -> Self {
        for bucket in buckets {
            std::fs::create_dir_all(plant.path(bucket)).unwrap();
        }
        let mut builder = S3ServiceBuilder::new(FileSystem::new(plant.path("")).unwrap());
        builder.set_auth(SimpleAuth::from_single("key", "secret"));
        let service = builder.build();
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let right: Answers = Arc::new(|_, _, _| Answer::Right);
        let server = Self {
            port: listener.local_addr().unwrap().port(),
            answers: Arc::new(Mutex::new(right)),
            asked: Arc::default(),
        };
        let (answers, asked) = (server.answers.clone(), server.asked.clone());
        tokio::spawn(async move {
            while let Ok((stream, _)) = listener.accept().await {
                let (service, answers, asked) = (service.clone(), answers.clone(), asked.clone());
                let each = service_fn(move |request| {
                    let answers = answers.lock().unwrap().clone();
                    let number = asked.fetch_add(1, Ordering::Relaxed);
                    let answer = answers(number, request.method(), request.uri().path());
                    answered(service.clone(), request, answer)
                });
                let http = hyper::server::conn::http1::Builder::new();
                tokio::spawn(http.serve_connection(TokioIo::new(stream), each));
            }
        });
        server
    }

    /// From now on.
    pub fn answers(&self, how: impl Fn(usize, &Method, &str) -> Answer + Send + Sync + 'static) {
        *self.answers.lock().unwrap() = Arc::new(how);
    }

    /// Requests so far.
    pub fn asked(&self) -> usize {
        self.asked.load(Ordering::Relaxed)
    }

    /// What leads a process to it.
    pub fn environment(&self) -> Vec<(String, String)> {
        let endpoint = format!("http://127.0.0.1:{}", self.port);
        [
            ("AWS_ENDPOINT_URL", endpoint.as_str()),
            ("AWS_ALLOW_HTTP", "true"),
            ("AWS_ACCESS_KEY_ID", "key"),
            ("AWS_SECRET_ACCESS_KEY", "secret"),
            ("AWS_TIMEOUT", "1 s"),
        ]
        .map(|(name, value)| (name.to_owned(), value.to_owned()))
        .to_vec()
    }

    /// What the program says and how long it takes, asked for this.
    pub async fn program(&self, arguments: &[&str]) -> Said {
        let mut command = Command::new(env!("CARGO_BIN_EXE_snug-plant"));
        command.args(arguments).envs(self.environment());
        command.env("RUST_LOG", "error");
        let began = Instant::now();
        let output = tokio::task::spawn_blocking(move || command.output().unwrap());
        let output = output.await.unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        Said {
            code: output.status.code(),
            output: text(output.stdout),
            error: text(output.stderr),
            took: began.elapsed(),
        }
    }
}

/// What a program said.
#[derive(Debug)]
pub struct Said {
    pub code: Option<i32>,
    pub output: String,
    pub error: String,
    pub took: Duration,
}

async fn answered(
    service: S3Service,
    request: Request<Incoming>,
    answer: Answer,
) -> Result<Response<s3s::Body>, s3s::HttpError> {
    match answer {
        Answer::Right => {}
        Answer::Late(by) => tokio::time::sleep(by).await,
        Answer::Never => std::future::pending().await,
        Answer::Busy => {
            let mut busy = Response::new(s3s::Body::empty());
            *busy.status_mut() = StatusCode::SERVICE_UNAVAILABLE;
            return Ok(busy);
        }
    }
    Service::call(&service, request).await
}
