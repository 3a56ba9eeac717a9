//! The kind of processor of this machine, because rounding differs between kinds.

/// Instruction set, widest vector extension and, if the system provides it, the name of the processor.
pub fn processor() -> String {
    let name = std::fs::read_to_string("/proc/cpuinfo")
        .ok()
        .and_then(|text| {
            let line = text.lines().find(|line| line.starts_with("model name"))?;
            Some(format!(", {}", line.split_once(':')?.1.trim()))
        });
    let (set, vectors) = (std::env::consts::ARCH, vectors());
    format!("{set}{vectors}{}", name.unwrap_or_default())
}

#[cfg(target_arch = "x86_64")]
fn vectors() -> &'static str {
    if is_x86_feature_detected!("avx512f") {
        " with AVX-512"
    } else if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        " with AVX2 and FMA"
    } else {
        ""
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn vectors() -> &'static str {
    ""
}
