# Flags for the project's own code. The same numbers must come out of every build of one machine: no -ffast-math.
add_library(isophote_flags INTERFACE)
target_compile_options(isophote_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(PROJECT_IS_TOP_LEVEL)
  target_compile_options(isophote_flags INTERFACE -Werror)
endif()
# gcc 12 warns falsely inside its own standard library at -O3.
target_compile_options(isophote_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-stringop-overflow -Wno-maybe-uninitialized -Wno-restrict>)
if(ISOPHOTE_SANITIZE)
  target_compile_options(isophote_flags INTERFACE -fsanitize=${ISOPHOTE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(isophote_flags INTERFACE -fsanitize=${ISOPHOTE_SANITIZE})
endif()
