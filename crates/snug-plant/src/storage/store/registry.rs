//! Places by the URLs in plans: what a scheduler or worker is asked to read, it opens by itself.

use super::Store;
use datafusion::common::DataFusionError;
use datafusion::execution::object_store::{DefaultObjectStoreRegistry, ObjectStoreRegistry};
use object_store::ObjectStore;
use std::sync::Arc;
use url::Url;

/// Every folder of this machine, and every bucket that the environment leads to.
#[derive(Debug, Default)]
pub(crate) struct Places(DefaultObjectStoreRegistry);

impl ObjectStoreRegistry for Places {
    fn register_store(
        &self,
        url: &Url,
        store: Arc<dyn ObjectStore>,
    ) -> Option<Arc<dyn ObjectStore>> {
        self.0.register_store(url, store)
    }

    fn get_store(&self, url: &Url) -> Result<Arc<dyn ObjectStore>, DataFusionError> {
        if let Ok(known) = self.0.get_store(url) {
            return Ok(known);
        }
        let opened = Store::open(url.as_str());
        let opened = opened.map_err(|error| DataFusionError::External(Box::new(error)))?;
        let (root, objects) = opened.engine_store();
        self.0.register_store(&root, Arc::clone(&objects));
        Ok(objects)
    }
}
