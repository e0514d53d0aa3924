# SPDX-FileCopyrightText: 2026 The Enfilade authors
# SPDX-License-Identifier: Apache-2.0
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
find_program(ENFILADE_CCACHE ccache)
if(ENFILADE_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ENFILADE_CCACHE})
endif()
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wno-psabi)
if(ENFILADE_WERROR)
  add_compile_options(-Werror)
endif()
# The same bytes on every machine: no fused multiply-add and no value-changing float optimisation,
# except what each loop asks for itself.
add_compile_options(-ffp-contract=off)
if(ENFILADE_SANITIZE)
  add_compile_options(-fsanitize=${ENFILADE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${ENFILADE_SANITIZE})
endif()
find_package(Threads REQUIRED)
