# deal.II ships a CMake config that rewrites build type and flags; its library, headers and the few
# packages that those headers include are all that is needed here.
find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(BLAS REQUIRED)
find_package(LAPACK REQUIRED)
find_package(MPI REQUIRED COMPONENTS C CXX)
pkg_check_modules(TOMLPP REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(CLI11 REQUIRED IMPORTED_TARGET CLI11)

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
add_library(wheelwright_cholmod INTERFACE)
target_include_directories(wheelwright_cholmod SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})
target_link_libraries(wheelwright_cholmod INTERFACE ${CHOLMOD_LIBRARY} LAPACK::LAPACK BLAS::BLAS)

find_path(DEAL_II_INCLUDE_DIR deal.II/non_matching/quadrature_generator.h REQUIRED)
find_library(DEAL_II_LIBRARY deal.ii REQUIRED)
add_library(wheelwright_dealii INTERFACE)
target_include_directories(wheelwright_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIR})
target_link_libraries(wheelwright_dealii INTERFACE ${DEAL_II_LIBRARY} MPI::MPI_CXX)
