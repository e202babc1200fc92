find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(BLAS REQUIRED)
find_package(LAPACK REQUIRED)
find_package(nanoflann REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
find_package(TBB REQUIRED)
pkg_check_modules(TOMLPP REQUIRED IMPORTED_TARGET tomlplusplus)
# Drawn into the page that explains a run.
find_file(CHART_JS chart.min.js PATHS /usr/share/javascript/chart.js /usr/share/javascript REQUIRED)
pkg_check_modules(CLI11 REQUIRED IMPORTED_TARGET CLI11)

# The C interfaces of BLAS and LAPACK. OpenBLAS has the cblas functions itself; liblapacke calls the LAPACK of the BLAS
# that is linked before it.
find_path(CBLAS_INCLUDE_DIR cblas.h PATH_SUFFIXES openblas REQUIRED)
find_path(LAPACKE_INCLUDE_DIR lapacke.h REQUIRED)
find_library(LAPACKE_LIBRARY lapacke REQUIRED)
add_library(wheelwright_lapack INTERFACE)
target_include_directories(wheelwright_lapack SYSTEM INTERFACE ${CBLAS_INCLUDE_DIR} ${LAPACKE_INCLUDE_DIR})
target_compile_definitions(wheelwright_lapack INTERFACE
  "lapack_complex_float=std::complex<float>" "lapack_complex_double=std::complex<double>")
target_link_libraries(wheelwright_lapack INTERFACE BLAS::BLAS LAPACK::LAPACK ${LAPACKE_LIBRARY})

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
add_library(wheelwright_cholmod INTERFACE)
target_include_directories(wheelwright_cholmod SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})
target_link_libraries(wheelwright_cholmod INTERFACE ${CHOLMOD_LIBRARY} wheelwright_lapack)
