# SPDX-FileCopyrightText: 2026 The Enfilade authors
# SPDX-License-Identifier: Apache-2.0
# Everything comes from Debian packages (scripts/install_deps.sh); docs/decisions says why each one.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs features2d)
find_package(CGAL REQUIRED)
include(CGAL_Eigen3_support)
find_package(GLPK REQUIRED)  # CGAL's module
include(CGAL_GLPK_support)
find_package(Ceres REQUIRED)
find_package(Boost REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(embree 3 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(pugixml REQUIRED IMPORTED_TARGET pugixml)
pkg_check_modules(geos REQUIRED IMPORTED_TARGET geos)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo cairo-svg)
find_package(CLI11 REQUIRED)
if(ENFILADE_BUILD_TESTS)
  find_package(GTest REQUIRED)
  find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs video videoio)  # reads back what we write
  pkg_check_modules(tinygltf REQUIRED IMPORTED_TARGET tinygltf)  # reads back what we write
endif()
if(ENFILADE_BUILD_BENCHMARKS)
  find_package(benchmark REQUIRED)
  find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs ximgproc)  # a rival
endif()
