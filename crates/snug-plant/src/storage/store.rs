//! Where a dataset lies: a local folder, or a bucket of an S3-compatible store. Objects are there whole or not at all.

mod bucket;
mod registry;
mod thresholds;

pub(crate) use registry::Places;

use crate::error::PlantError;
use bytes::Bytes;
use futures::TryStreamExt;
use object_store::local::LocalFileSystem;
use object_store::path::Path;
use object_store::{ObjectStore, ObjectStoreExt};
use std::sync::Arc;
use url::Url;

/// A place for objects, with everything below one prefix.
#[derive(Debug, Clone)]
pub struct Store {
    root: Url,
    objects: Arc<dyn ObjectStore>,
    prefix: Path,
}

impl Store {
    /// Opens a folder's path, `file:///FOLDER/` or `s3://BUCKET/FOLDER/`; a bucket's endpoint and credentials stand in the environment.
    ///
    /// # Errors
    /// [`PlantError::Place`] for what leads nowhere.
    pub fn open(text: &str) -> Result<Self, PlantError> {
        let place = |reason: String| PlantError::Place {
            url: snug_campaign::excerpt(text),
            reason,
        };
        let url = match text.contains("://") {
            true => Url::parse(text).map_err(|error| place(error.to_string()))?,
            false => std::path::absolute(text)
                .ok()
                .and_then(|path| Url::from_directory_path(path).ok())
                .ok_or_else(|| place("it is no path".to_owned()))?,
        };
        if !url.username().is_empty() || url.password().is_some() || url.query().is_some() {
            let reason = "credentials come from the environment, never in a URL".to_owned();
            return Err(place(reason));
        }
        match url.scheme() {
            "file" => {
                let path = url
                    .to_file_path()
                    .map_err(|()| place("it is no path".to_owned()))?;
                let prefix = Path::from_absolute_path(&path).or_else(|_| {
                    std::fs::create_dir_all(&path).map_err(|error| place(error.to_string()))?;
                    Path::from_absolute_path(&path).map_err(|error| place(error.to_string()))
                })?;
                Ok(Self {
                    root: url,
                    objects: Arc::new(LocalFileSystem::new()),
                    prefix,
                })
            }
            "s3" => {
                let name = url.host_str().filter(|name| !name.is_empty());
                let name = name.ok_or_else(|| place("it names no bucket".to_owned()))?;
                let opened = bucket::bucket(name).map_err(|error| place(error.to_string()))?;
                let prefix = Path::from_url_path(url.path());
                Ok(Self {
                    objects: opened,
                    prefix: prefix.map_err(|error| place(error.to_string()))?,
                    root: url,
                })
            }
            scheme => {
                let reason =
                    format!("{scheme:?} is not known; known are folders, file:// and s3://");
                Err(place(reason))
            }
        }
    }

    /// A place below this one.
    ///
    /// # Errors
    /// As [`Store::open`].
    pub(crate) fn below(&self, name: &str) -> Result<Self, PlantError> {
        let root = self.root.as_str().trim_end_matches('/');
        Self::open(&format!("{root}/{name}/"))
    }

    /// The place as it is told.
    pub fn url(&self) -> &str {
        self.root.as_str()
    }

    /// The store behind it and the URL by which the engine knows that.
    pub(crate) fn engine_store(&self) -> (Url, Arc<dyn ObjectStore>) {
        let mut url = self.root.clone();
        url.set_path("/");
        (url, Arc::clone(&self.objects))
    }

    fn path(&self, name: &str) -> Path {
        let parts = self.prefix.parts();
        let name: Path = name.into();
        parts.chain(name.parts()).collect()
    }

    /// An object's name as the engine wants it.
    pub(crate) fn url_of(&self, name: &str) -> String {
        let (mut url, _) = self.engine_store();
        url.set_path(&format!("/{}", self.path(name)));
        url.to_string()
    }

    fn failed(&self, name: &str) -> impl Fn(object_store::Error) -> PlantError {
        let object = self.url_of(name);
        move |source| PlantError::Store {
            object: object.clone(),
            source,
        }
    }

    /// Puts an object, whole: until the last byte is there, the one before stands, or none.
    pub(crate) async fn put(&self, name: &str, bytes: Vec<u8>) -> Result<(), PlantError> {
        let done = self.objects.put(&self.path(name), bytes.into()).await;
        done.map(|_| ()).map_err(self.failed(name))
    }

    /// An object's content; `None` where there is none of this name.
    pub(crate) async fn get(&self, name: &str) -> Result<Option<Bytes>, PlantError> {
        let failed = self.failed(name);
        match self.objects.get(&self.path(name)).await {
            Ok(found) => found.bytes().await.map(Some).map_err(failed),
            Err(object_store::Error::NotFound { .. }) => Ok(None),
            Err(error) => Err(failed(error)),
        }
    }

    /// Takes an object away, if it is there.
    pub(crate) async fn remove(&self, name: &str) -> Result<(), PlantError> {
        match self.objects.delete(&self.path(name)).await {
            Ok(()) | Err(object_store::Error::NotFound { .. }) => Ok(()),
            Err(error) => Err(self.failed(name)(error)),
        }
    }

    /// Names of the objects below `folder`, sorted, as [`Store::get`] takes them.
    pub(crate) async fn list(&self, folder: &str) -> Result<Vec<String>, PlantError> {
        let failed = self.failed(folder);
        let listed = self.objects.list(Some(&self.path(folder)));
        let found: Vec<_> = listed.try_collect().await.map_err(failed)?;
        let below = self.prefix.parts().count();
        let name = |path: &Path| {
            let parts: Vec<_> = path.parts().skip(below).collect();
            let parts: Vec<&str> = parts.iter().map(AsRef::as_ref).collect();
            parts.join("/")
        };
        let mut names: Vec<String> = found.iter().map(|found| name(&found.location)).collect();
        names.sort();
        Ok(names)
    }
}
