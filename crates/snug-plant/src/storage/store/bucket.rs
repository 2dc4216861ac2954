//! Buckets of S3-compatible stores: opened from the environment, asked again where they do not answer, but not for ever.

use super::thresholds::{CONNECTS_WITHIN_S, MOST_RETRIES, REQUEST_WITHIN_S, RETRIED_FOR_S};
use object_store::aws::{AmazonS3Builder, AmazonS3ConfigKey};
use object_store::{ClientConfigKey, ObjectStore, RetryConfig};
use std::sync::Arc;
use std::time::Duration;

/// What stands in the environment for how long a request may take, with its default \[s\].
const LIMITS: [(&str, ClientConfigKey, u64); 2] = [
    ("AWS_TIMEOUT", ClientConfigKey::Timeout, REQUEST_WITHIN_S),
    (
        "AWS_CONNECT_TIMEOUT",
        ClientConfigKey::ConnectTimeout,
        CONNECTS_WITHIN_S,
    ),
];

/// The bucket of this name. Where it is and who asks for it say the environment's `AWS_…` variables, and nothing else.
pub(super) fn bucket(name: &str) -> Result<Arc<dyn ObjectStore>, object_store::Error> {
    let mut builder = AmazonS3Builder::from_env()
        .with_bucket_name(name)
        .with_retry(RetryConfig {
            max_retries: MOST_RETRIES,
            retry_timeout: Duration::from_secs(RETRIED_FOR_S),
            ..RetryConfig::default()
        });
    for (variable, key, usual_s) in LIMITS {
        if std::env::var_os(variable).is_none() {
            builder = builder.with_config(AmazonS3ConfigKey::Client(key), format!("{usual_s} s"));
        }
    }
    Ok(Arc::new(builder.build()?))
}
