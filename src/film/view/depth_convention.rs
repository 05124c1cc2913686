//! Conventions of data sets for depths in 16 bits.

use crate::named::named;

/// A data set whose depth images are PNG files of 16 bits. In all of them a value is the planar
/// depth `Z` in metres times a scale, and 0 means that there is no depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DepthConvention {
    /// The RGB-D benchmark of TU Munich, and data sets in its format, such as ICL-NUIM.
    Tum,
    /// The depth benchmarks of KITTI.
    Kitti,
    /// ScanNet: millimetres, like most sensors.
    Scannet,
}

named!(DepthConvention: Tum => "tum", Kitti => "kitti", Scannet => "scannet");

impl DepthConvention {
    /// Steps a metre.
    pub fn scale(self) -> f64 {
        match self {
            DepthConvention::Tum => 5000.0,
            DepthConvention::Kitti => 256.0,
            DepthConvention::Scannet => 1000.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::view::Depth16;

    #[test]
    fn the_default_is_that_of_scannet() {
        assert_eq!(DepthConvention::Scannet.scale(), Depth16::SCALE);
    }
}
