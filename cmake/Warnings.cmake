add_library(wheelwright_warnings INTERFACE)
target_compile_options(wheelwright_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wno-unused-parameter)
