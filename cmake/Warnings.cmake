add_library(wheelwright_warnings INTERFACE)
# Files that are compiled together are not warned about what only their neighbours declare; the preset `lint` compiles each by
# itself.
target_compile_options(wheelwright_warnings INTERFACE -Wall -Wextra -Wpedantic -Wno-unused-parameter
  "$<IF:$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>,-Wshadow=local;-Wno-subobject-linkage,-Wshadow>")
