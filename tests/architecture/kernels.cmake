# cmake -DNM=... -DOBJECTS=a.o;b.o -P kernels.cmake: fails if one of the objects has a weak symbol, that is an inline
# function of linkage. The linker keeps one copy of these for everybody, and it could be one for other processors.
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} --demangle ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]* [WVu] [^\n]*" weak "${symbols}")
  if(weak)
    message(SEND_ERROR "${object}: ${weak}")
  endif()
endforeach()
