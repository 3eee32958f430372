# Builds the pages of tools/web and makes them part of retarget_face.
set(WEB_DIR ${PROJECT_SOURCE_DIR}/tools/web)
set(EMBEDDED_FILES ${WEB_DIR}/src/shared/theme.css ${WEB_DIR}/src/report/report.css)
set(EMBEDDED_DEFINITIONS RETARGET_THEME_CSS="${WEB_DIR}/src/shared/theme.css"
                         RETARGET_REPORT_CSS="${WEB_DIR}/src/report/report.css")

find_program(NPM npm)
if(NPM)
  set(STUDIO_DEFAULT ON)
else()
  set(STUDIO_DEFAULT OFF)
endif()
option(RETARGET_STUDIO "Build the studio and the report page with players (needs npm)"
       ${STUDIO_DEFAULT})

if(RETARGET_STUDIO)
  if(NOT NPM)
    message(FATAL_ERROR "RETARGET_STUDIO needs npm (Debian: apt install npm); "
                        "-DRETARGET_STUDIO=OFF builds without studio and players")
  endif()
  # A copy is built, so that the source tree stays clean.
  set(WEB_BUILD ${PROJECT_BINARY_DIR}/web)
  set(WEB_INSTALLED ${WEB_BUILD}/installed)
  set(WEB_PAGES ${WEB_BUILD}/dist/report.html ${WEB_BUILD}/dist/studio.html)
  file(GLOB_RECURSE WEB_SOURCES CONFIGURE_DEPENDS ${WEB_DIR}/src/*)
  list(APPEND WEB_SOURCES ${WEB_DIR}/report.html ${WEB_DIR}/studio.html ${WEB_DIR}/tsconfig.json
       ${WEB_DIR}/vite.config.ts)
  set(RUN_NPM ${CMAKE_COMMAND} -DNPM=${NPM} -DSOURCE=${WEB_DIR} -DBUILD=${WEB_BUILD})
  add_custom_command(
    OUTPUT ${WEB_INSTALLED}
    COMMAND ${RUN_NPM} -DSTEP=install -P ${WEB_DIR}/npm.cmake
    COMMAND ${CMAKE_COMMAND} -E touch ${WEB_INSTALLED}
    DEPENDS ${WEB_DIR}/package.json ${WEB_DIR}/package-lock.json ${WEB_DIR}/npm.cmake
    COMMENT "Installing what the pages are built with (npm ci)" VERBATIM)
  add_custom_command(
    OUTPUT ${WEB_PAGES}
    COMMAND ${RUN_NPM} -DSTEP=build -P ${WEB_DIR}/npm.cmake
    DEPENDS ${WEB_INSTALLED} ${WEB_SOURCES}
    COMMENT "Building the pages" VERBATIM)
  list(APPEND EMBEDDED_FILES ${WEB_PAGES})
  list(APPEND EMBEDDED_DEFINITIONS RETARGET_REPORT_PAGE="${WEB_BUILD}/dist/report.html"
                                   RETARGET_STUDIO_PAGE="${WEB_BUILD}/dist/studio.html")
else()
  message(STATUS "RETARGET_STUDIO is OFF: no studio, and report.html has no players")
endif()

set_source_files_properties(${PROJECT_SOURCE_DIR}/tools/report/embedded_page.cc
                            TARGET_DIRECTORY retarget_face PROPERTIES
                            OBJECT_DEPENDS "${EMBEDDED_FILES}"
                            COMPILE_DEFINITIONS "${EMBEDDED_DEFINITIONS}")
