# Which processors the code is for. A native build is for that of this machine. A portable one, -DWHEELWRIGHT_NATIVE=OFF,
# runs on every processor of the architecture; for x86-64 it holds the library three times, and the loader of glibc
# takes, by itself, the one of the highest level that the processor has: from the folder glibc-hwcaps/LEVEL beside the
# one for all.
set(processor_levels "")
if(WHEELWRIGHT_NATIVE)
  add_compile_options(-march=native)
elseif(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(processor_levels x86-64-v3 x86-64-v4)
endif()
