find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(BLAS REQUIRED)
find_package(LAPACK REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
find_package(MPI REQUIRED COMPONENTS C CXX)
pkg_check_modules(TOMLPP REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(CLI11 REQUIRED IMPORTED_TARGET CLI11)

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
add_library(wheelwright_cholmod INTERFACE)
target_include_directories(wheelwright_cholmod SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})
target_link_libraries(wheelwright_cholmod INTERFACE ${CHOLMOD_LIBRARY} LAPACK::LAPACK BLAS::BLAS)

# deal.II's own target setup would append -O2 and -std=c++17: take its library and header paths only.
find_package(deal.II 9.4 REQUIRED)
find_library(DEAL_II_RELEASE_LIBRARY deal.ii REQUIRED)
add_library(wheelwright_dealii INTERFACE)
target_include_directories(wheelwright_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
target_link_libraries(wheelwright_dealii INTERFACE ${DEAL_II_RELEASE_LIBRARY} MPI::MPI_CXX)
# deal.II's headers call into the libraries that it depends on itself.
target_link_options(wheelwright_dealii INTERFACE -Wl,--copy-dt-needed-entries)
