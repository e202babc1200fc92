#pragma once

namespace wheelwright {

/// The kernels of OpenBLAS that are fastest on this processor and that OpenBLAS may not choose itself, as a
/// value of OPENBLAS_CORETYPE; null if its own choice is right. Can be asked before BLAS is loaded.
const char* fastest_kernels();

}  // namespace wheelwright
