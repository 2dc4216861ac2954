//! A headless Chromium, and a page of the workbench in it.

use chromiumoxide::cdp::browser_protocol::emulation::{
    MediaFeature, SetDeviceMetricsOverrideParams,
};
use chromiumoxide::cdp::browser_protocol::input::{
    DispatchKeyEventParams, DispatchKeyEventType, DispatchMouseEventParams, DispatchMouseEventType,
    MouseButton,
};
use chromiumoxide::cdp::browser_protocol::network::{EnableParams, EventRequestWillBeSent};
use chromiumoxide::cdp::js_protocol::runtime::{EventConsoleApiCalled, EventExceptionThrown};
use chromiumoxide::layout::Point;
use chromiumoxide::{Browser, BrowserConfig, Page};
use serde_json::Value;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use tokio_stream::StreamExt;

/// Longest that is waited for something to show: a test of one effect on a machine that does something else. Chosen.
const PATIENCE: Duration = Duration::from_secs(120);

/// The browser that `SNUG_CHROMIUM` names, which then must be there, or one that is found on the path.
pub fn installed() -> Option<PathBuf> {
    if let Some(named) = std::env::var_os("SNUG_CHROMIUM") {
        let path = PathBuf::from(named);
        assert!(path.is_file(), "SNUG_CHROMIUM = {path:?} is no file");
        return Some(path);
    }
    let folders = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let found = std::env::split_paths(&folders)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|path| path.is_file());
    if found.is_none() {
        println!("skipped: no Chromium is installed");
    }
    found
}

/// Longest that is waited for a page to say that it has loaded, which it may never. Chosen.
pub const LOADING: Duration = Duration::from_secs(5);

/// One browser at a time: what is timed in it has the machine for itself.
static ALONE: tokio::sync::Mutex<()> = tokio::sync::Mutex::const_new(());

/// A browser without a window, for as long as the value lives.
pub struct Headless {
    _alone: tokio::sync::MutexGuard<'static, ()>,
    browser: Browser,
    _profile: TempDir,
}

impl Headless {
    pub async fn launch(program: PathBuf) -> Self {
        let alone = ALONE.lock().await;
        let profile = TempDir::new().unwrap();
        let config = BrowserConfig::builder()
            .chrome_executable(program)
            .user_data_dir(profile.path())
            .new_headless_mode()
            .no_sandbox()
            .launch_timeout(PATIENCE)
            .request_timeout(PATIENCE)
            .build()
            .unwrap();
        let (browser, mut handler) = Browser::launch(config).await.unwrap();
        tokio::spawn(async move { while handler.next().await.is_some() {} });
        Self {
            _alone: alone,
            browser,
            _profile: profile,
        }
    }

    /// A page as wide as that, at an address.
    pub async fn open(&self, address: &str, width: i64, scheme: &str) -> Tab {
        let page = self.browser.new_page("about:blank").await.unwrap();
        page.execute(EnableParams::default()).await.unwrap();
        let size = SetDeviceMetricsOverrideParams::new(width, 1000, 1.0, width < 600);
        page.execute(size).await.unwrap();
        let colours = MediaFeature::new("prefers-color-scheme", scheme);
        page.emulate_media_features(vec![colours]).await.unwrap();
        let tab = Tab {
            faults: Arc::default(),
            asked: Arc::default(),
            page,
        };
        tab.listen().await;
        // The page that waits for the tightenings reloads itself: that it has loaded is no end to wait for.
        (tokio::time::timeout(LOADING, tab.page.goto(address)).await).ok();
        tab
    }

    pub async fn close(mut self) {
        self.browser.close().await.unwrap();
        self.browser.wait().await.unwrap();
    }
}

/// One page, with what went wrong in it and what it asked for.
pub struct Tab {
    pub page: Page,
    pub faults: Arc<Mutex<Vec<String>>>,
    pub asked: Arc<Mutex<Vec<String>>>,
}

impl Tab {
    async fn listen(&self) {
        let mut thrown = self
            .page
            .event_listener::<EventExceptionThrown>()
            .await
            .unwrap();
        let mut said = self
            .page
            .event_listener::<EventConsoleApiCalled>()
            .await
            .unwrap();
        let mut sent = self
            .page
            .event_listener::<EventRequestWillBeSent>()
            .await
            .unwrap();
        let (faults, more, asked) = (
            Arc::clone(&self.faults),
            Arc::clone(&self.faults),
            Arc::clone(&self.asked),
        );
        tokio::spawn(async move {
            while let Some(event) = thrown.next().await {
                faults
                    .lock()
                    .unwrap()
                    .push(format!("{:?}", event.exception_details));
            }
        });
        tokio::spawn(async move {
            while let Some(event) = said.next().await {
                more.lock().unwrap().push(format!("{:?}", event.args));
            }
        });
        tokio::spawn(async move {
            while let Some(event) = sent.next().await {
                asked.lock().unwrap().push(event.request.url.clone());
            }
        });
    }

    /// What an expression of the page comes to; nothing while another page is being loaded.
    pub async fn value(&self, expression: &str) -> Value {
        let told = self.page.evaluate_expression(expression).await;
        told.ok()
            .and_then(|told| told.value().cloned())
            .unwrap_or(Value::Null)
    }

    /// The text of the element with this data attribute; nothing where it is not there.
    pub async fn text(&self, name: &str) -> String {
        let text = self
            .value(&format!(
                "document.querySelector('[data-{name}]')?.textContent ?? ''"
            ))
            .await;
        text.as_str().unwrap_or("").replace('\u{a0}', " ")
    }

    /// Waits until an expression is true.
    pub async fn until(&self, expression: &str) {
        let begun = Instant::now();
        while self.value(expression).await != Value::Bool(true) {
            assert!(begun.elapsed() < PATIENCE, "it never came to {expression}");
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }

    /// Waits until the study's own model is fitted, its error said, and everything that follows from it.
    pub async fn is_ready(&self, error: &str) {
        self.until(&format!(
            "document.querySelector('[data-error]')?.textContent === '{error}'"
        ))
        .await;
        self.until("(document.querySelector('[data-usable]')?.textContent ?? '') !== ''")
            .await;
    }

    /// Clicks where a person would: in the middle of what is on screen.
    pub async fn click(&self, selector: &str) {
        self.page.bring_to_front().await.unwrap();
        let element = self.page.find_element(selector).await;
        let element = element.unwrap_or_else(|error| panic!("{selector}: {error}"));
        element.click().await.unwrap();
    }

    /// Presses a key, whatever has the focus.
    pub async fn press(&self, key: &str) {
        let code = match key {
            "Tab" => 9,
            "Enter" => 13,
            "ArrowRight" => 39,
            " " => 32,
            other => panic!("no story presses {other}"),
        };
        for kind in [
            DispatchKeyEventType::RawKeyDown,
            DispatchKeyEventType::Char,
            DispatchKeyEventType::KeyUp,
        ] {
            let mut event = DispatchKeyEventParams::new(kind.clone());
            event.key = Some(key.to_owned());
            event.code = Some(if key == " " { "Space" } else { key }.to_owned());
            event.windows_virtual_key_code = Some(code);
            if matches!(kind, DispatchKeyEventType::Char) {
                match key {
                    "Enter" => event.text = Some("\r".to_owned()),
                    " " => event.text = Some(" ".to_owned()),
                    _ => continue,
                }
            }
            self.page.execute(event).await.unwrap();
        }
    }

    /// Drags across the first figure, between two shares of its width.
    pub async fn drag(&self, from: f64, to: f64) {
        let figure = self.page.find_element("[data-panel] svg").await.unwrap();
        figure.scroll_into_view().await.unwrap();
        let shape = figure.bounding_box().await.unwrap();
        let at = |share: f64| Point {
            x: shape.x + share * shape.width,
            y: shape.y + 0.5 * shape.height,
        };
        for (kind, share) in [
            (DispatchMouseEventType::MouseMoved, from),
            (DispatchMouseEventType::MousePressed, from),
            (DispatchMouseEventType::MouseMoved, 0.5 * (from + to)),
            (DispatchMouseEventType::MouseMoved, to),
            (DispatchMouseEventType::MouseReleased, to),
        ] {
            let Point { x, y } = at(share);
            let mut event = DispatchMouseEventParams::new(kind, x, y);
            event.button = Some(MouseButton::Left);
            event.buttons = Some(1);
            event.click_count = Some(1);
            self.page.execute(event).await.unwrap();
        }
    }

    /// Nothing went wrong, and nothing was asked of another machine.
    pub fn was_well(&self, port: u16) {
        assert_eq!(*self.faults.lock().unwrap(), Vec::<String>::new());
        let asked = self.asked.lock().unwrap();
        assert!(asked.len() > 3, "{asked:?}");
        let own = format!("http://127.0.0.1:{port}/");
        let stranger = asked
            .iter()
            .find(|url| !url.starts_with(&own) && !url.starts_with("data:"));
        assert_eq!(stranger, None);
    }
}
