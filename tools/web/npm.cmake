# One step of the pages' build, with a message that helps where it fails:
#   cmake -DNPM=npm -DSOURCE=tools/web -DBUILD=build/web -DSTEP=install|build -P npm.cmake
file(MAKE_DIRECTORY ${BUILD})
file(COPY ${SOURCE}/package.json ${SOURCE}/package-lock.json ${SOURCE}/.npmrc DESTINATION ${BUILD})
if(STEP STREQUAL "install")
  set(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error)
else()
  file(REMOVE_RECURSE ${BUILD}/src)
  file(COPY ${SOURCE}/src ${SOURCE}/report.html ${SOURCE}/tsconfig.json ${SOURCE}/vite.config.ts
       DESTINATION ${BUILD})
  set(COMMAND ${NPM} run --silent build -- --outDir dist --logLevel warn)
endif()
execute_process(COMMAND ${COMMAND} WORKING_DIRECTORY ${BUILD} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "`${COMMAND}` failed in ${BUILD}: the report page cannot be built. "
                      "-DRETARGET_STUDIO=OFF builds a report page without players.")
endif()
if(STEP STREQUAL "build")
  file(TOUCH ${BUILD}/dist/report.html)
endif()
