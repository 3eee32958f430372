# One step of the pages' build, with a message that helps where it fails:
#   cmake -DNPM=npm -DSOURCE=tools/web -DBUILD=build/web -DSTEP=install|build -P npm.cmake
file(MAKE_DIRECTORY ${BUILD})
file(COPY ${SOURCE}/package.json ${SOURCE}/package-lock.json ${SOURCE}/.npmrc DESTINATION ${BUILD})

function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${BUILD} RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "`${ARGV}` failed in ${BUILD}: the pages cannot be built. "
                        "-DRETARGET_STUDIO=OFF builds without studio and players.")
  endif()
endfunction()

if(STEP STREQUAL "install")
  run(${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error)
else()
  set(PAGES report studio)
  file(REMOVE_RECURSE ${BUILD}/src)
  list(TRANSFORM PAGES PREPEND ${SOURCE}/ OUTPUT_VARIABLE FILES)
  list(TRANSFORM FILES APPEND .html)
  file(COPY ${SOURCE}/src ${FILES} ${SOURCE}/tsconfig.json ${SOURCE}/vite.config.ts
       DESTINATION ${BUILD})
  run(${NPM} run --silent check)
  foreach(PAGE ${PAGES})
    set(ENV{PAGE} ${PAGE})
    run(${NPM} run --silent build -- --outDir dist --logLevel warn)
    file(TOUCH ${BUILD}/dist/${PAGE}.html)
  endforeach()
endif()
