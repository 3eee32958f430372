# The public headers: the library's face, the data model, and what these include. They are laid out
# as users see them, <retarget/...>, in the build folder, from where they are installed.

# Adds to `list` the header `header` (relative to the project) and, after it, all it includes.
function(retarget_collect_header header list)
  set(collected ${${list}})
  if(header IN_LIST collected)
    return()
  endif()
  list(APPEND collected ${header})
  file(STRINGS ${PROJECT_SOURCE_DIR}/${header} lines REGEX "^#include \"")
  foreach(line ${lines})
    string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
    retarget_collect_header(${included} collected)
  endforeach()
  set(${list} ${collected} PARENT_SCOPE)
endfunction()

set(RETARGET_FACE tools/api/retarget.h)
file(GLOB_RECURSE model_headers RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
     ${PROJECT_SOURCE_DIR}/model/*.h)
set(headers "")
foreach(header ${RETARGET_FACE} ${model_headers})
  retarget_collect_header(${header} headers)
endforeach()
# An edited header may include others.
list(TRANSFORM headers PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources})

set(RETARGET_INCLUDE_DIR ${PROJECT_BINARY_DIR}/include)
foreach(header ${headers})
  file(READ ${PROJECT_SOURCE_DIR}/${header} text)
  string(REPLACE "#include \"${RETARGET_FACE}\"" "#include \"retarget/retarget.h\"" text "${text}")
  string(REGEX REPLACE "#include \"(model|solver|io|tools)/" "#include \"retarget/\\1/" text
         "${text}")
  if(header STREQUAL RETARGET_FACE)
    set(header retarget.h)
  endif()
  # Only where something changed, so that nobody who includes it is compiled again.
  file(CONFIGURE OUTPUT ${RETARGET_INCLUDE_DIR}/retarget/${header} CONTENT "${text}" @ONLY)
endforeach()
