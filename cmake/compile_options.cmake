# What every target of the project is compiled with.
#
# Results must not depend on the compiler's choices: contraction is off, and one baseline
# instruction set serves every machine. Nobody reads errno after a square root, which lets it be an
# instruction.
add_library(talus_compile_options INTERFACE)
target_compile_features(talus_compile_options INTERFACE cxx_std_20)
target_compile_options(talus_compile_options INTERFACE
  -ffp-contract=off -fno-math-errno -Wall -Wextra -Wshadow -Wconversion
  -Wno-missing-field-initializers)  # designated initialisers leave defaults out on purpose
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(talus_compile_options INTERFACE -march=x86-64-v3)
endif()
if(TALUS_WARNINGS_AS_ERRORS)
  target_compile_options(talus_compile_options INTERFACE -Werror)
endif()
if(TALUS_ENABLE_ASSERTS)
  target_compile_definitions(talus_compile_options INTERFACE TALUS_ENABLE_ASSERTS)
endif()
