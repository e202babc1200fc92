find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(BLAS REQUIRED)
find_package(LAPACK REQUIRED)
find_package(nanoflann REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(pugixml REQUIRED)
find_package(TBB REQUIRED)
pkg_check_modules(TOMLPP REQUIRED IMPORTED_TARGET tomlplusplus)
# Drawn into the page that explains a run.
find_file(CHART_JS chart.min.js PATHS /usr/share/javascript/chart.js /usr/share/javascript REQUIRED)
find_file(THREE_JS three.min.js PATHS /usr/share/javascript/three /usr/share/javascript REQUIRED)
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

# CGAL consists of headers; they use GMP.
find_path(CGAL_INCLUDE_DIR CGAL/Constrained_Delaunay_triangulation_2.h REQUIRED)
find_library(GMP_LIBRARY gmp REQUIRED)
add_library(wheelwright_cgal INTERFACE)
target_include_directories(wheelwright_cgal SYSTEM INTERFACE ${CGAL_INCLUDE_DIR})
target_link_libraries(wheelwright_cgal INTERFACE ${GMP_LIBRARY})

# Beast and Asio are headers too, of the package that CGAL needs.
find_package(Boost 1.74 REQUIRED)

# AGG draws pictures and becomes part of the library.
find_path(AGG_INCLUDE_DIR agg2/agg_path_storage.h REQUIRED)
find_library(AGG_LIBRARY agg_pic REQUIRED)
add_library(wheelwright_agg INTERFACE)
target_include_directories(wheelwright_agg SYSTEM INTERFACE ${AGG_INCLUDE_DIR} ${AGG_INCLUDE_DIR}/agg2)
target_link_libraries(wheelwright_agg INTERFACE ${AGG_LIBRARY})

# For plugins, which are left out where their library is missing.
find_path(OCCT_INCLUDE_DIR STEPControl_Writer.hxx PATH_SUFFIXES opencascade)
find_library(OCCT_STEP_LIBRARY TKSTEP)
find_path(LIB3MF_INCLUDE_DIR Model/COM/NMR_DLLInterfaces.h PATH_SUFFIXES lib3mf)
find_library(LIB3MF_LIBRARY 3MF)
