# SPDX-FileCopyrightText: 2026 The Enfilade authors
# SPDX-License-Identifier: Apache-2.0

# Every module, foundations first, then in the order of the data flow. The layer check
# (scripts/check_layers.py) reads this list: a module may use only modules that stand before it.
set(ENFILADE_MODULES
    base geometry optim image
    scene sfm evidence structure floorplan model exchange baselines evaluate
    synthetic pipeline)

set(CMAKE_VERIFY_INTERFACE_HEADER_SETS ON)

# enfilade_add_module(NAME n HEADERS h... SOURCES s... USES module... PUBLIC_LIBS l... PRIVATE_LIBS l...)
#
# HEADERS are public (below include/enfilade/<n>/), SOURCES are below src/<n>/ and may name private
# headers. USES names the modules whose headers this one may include. Third-party headers stay in
# .cc files, so their libraries are PRIVATE_LIBS; Eigen is the one public exception.
function(enfilade_add_module)
  cmake_parse_arguments(M "" "NAME" "HEADERS;SOURCES;USES;PUBLIC_LIBS;PRIVATE_LIBS" ${ARGN})
  set(target enfilade_${M_NAME})
  list(TRANSFORM M_HEADERS PREPEND ${CMAKE_SOURCE_DIR}/include/enfilade/${M_NAME}/)
  add_library(${target} STATIC)
  add_library(enfilade::${M_NAME} ALIAS ${target})
  target_sources(${target} PRIVATE ${M_SOURCES}
                 PUBLIC FILE_SET HEADERS BASE_DIRS ${CMAKE_SOURCE_DIR}/include FILES ${M_HEADERS})
  target_include_directories(${target} PUBLIC ${CMAKE_SOURCE_DIR}/include PRIVATE ${CMAKE_SOURCE_DIR})
  target_compile_features(${target} PUBLIC cxx_std_20)
  list(TRANSFORM M_USES PREPEND enfilade::)
  target_link_libraries(${target} PUBLIC Eigen3::Eigen ${M_USES} ${M_PUBLIC_LIBS} PRIVATE ${M_PRIVATE_LIBS})
endfunction()

# enfilade_add_test(MODULE m LABEL unit|stage|e2e|real|slow SOURCES s... LIBS l... [SUITES s...])
#
# One binary per module and label. Tests are called <module>.<suite>.<case>, each in a process of its own. SUITES are
# those whose cases share what takes long to make: each is one test in one process, called <module>.<suite>.
function(enfilade_add_test)
  cmake_parse_arguments(T "" "MODULE;LABEL;TIMEOUT" "SOURCES;LIBS;SUITES" ${ARGN})
  set(target test_${T_MODULE}_${T_LABEL})
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT 300)
  endif()
  add_executable(${target} ${T_SOURCES})
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR})
  # Tests spend their time in the library: compiling them fast matters more than running them fast.
  target_compile_options(${target} PRIVATE -O1)
  target_link_libraries(${target} PRIVATE ${T_LIBS} enfilade_test_support GTest::gmock GTest::gtest_main)
  include(GoogleTest)
  set(one_by_one "*")
  if(T_SUITES)
    list(TRANSFORM T_SUITES APPEND ".*" OUTPUT_VARIABLE cases)
    list(JOIN cases ":" cases)
    set(one_by_one "-${cases}")
  endif()
  gtest_discover_tests(${target} TEST_PREFIX ${T_MODULE}. TEST_FILTER ${one_by_one} DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS ${T_LABEL} TIMEOUT ${T_TIMEOUT})
  foreach(suite IN LISTS T_SUITES)
    add_test(NAME ${T_MODULE}.${suite} COMMAND ${target} --gtest_filter=${suite}.*)
    set_tests_properties(${T_MODULE}.${suite} PROPERTIES LABELS ${T_LABEL} TIMEOUT ${T_TIMEOUT})
  endforeach()
endfunction()
