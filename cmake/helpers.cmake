# One folder, one static library: vindu_library(core SOURCES ... PUBLIC ... PRIVATE ...).
set(VINDU_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wconversion
                   -Wno-sign-conversion -Werror)

function(vindu_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(vindu_${name} STATIC ${ARG_SOURCES})
  target_include_directories(vindu_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_compile_options(vindu_${name} PRIVATE ${VINDU_WARNINGS})
  target_link_libraries(vindu_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
endfunction()
