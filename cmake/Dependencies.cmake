# Every library we use, as imported targets that do not emit warnings of their own.
find_package(PkgConfig REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(fmt REQUIRED)
find_package(Boost 1.74 REQUIRED)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(NLOPT REQUIRED IMPORTED_TARGET nlopt)
pkg_check_modules(LIBCRYPTO REQUIRED IMPORTED_TARGET libcrypto)

# SUNDIALS by its files: its own CMake package asks for every library that it was ever built with, MPI among them.
find_path(SUNDIALS_INCLUDE_DIR cvodes/cvodes.h REQUIRED)
add_library(swimtwin_cvodes INTERFACE)
target_include_directories(swimtwin_cvodes SYSTEM INTERFACE ${SUNDIALS_INCLUDE_DIR})
foreach(part cvodes nvecserial sunmatrixdense sunlinsoldense sunnonlinsolfixedpoint)
  find_library(SUNDIALS_${part} sundials_${part} REQUIRED)
  target_link_libraries(swimtwin_cvodes INTERFACE ${SUNDIALS_${part}})
endforeach()

find_package(CLI11 REQUIRED)
find_package(Threads REQUIRED)

# Exactly one HDF5: deal.II's and PETSc's (Open MPI) in the full build, the serial one in the online half.
if(SWIMTWIN_ONLINE)
  pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial)
else()
  find_package(MPI REQUIRED COMPONENTS C CXX)
  pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-openmpi)
  target_link_libraries(PkgConfig::HDF5 INTERFACE MPI::MPI_C)

  find_package(deal.II 9.4.1 REQUIRED)
  add_library(swimtwin_dealii INTERFACE)
  target_include_directories(swimtwin_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
  if(CMAKE_BUILD_TYPE STREQUAL "Debug")
    set(SWIMTWIN_DEAL_II_LIBRARIES ${DEAL_II_LIBRARIES_DEBUG})
    target_compile_definitions(swimtwin_dealii INTERFACE DEBUG)
  else()
    set(SWIMTWIN_DEAL_II_LIBRARIES ${DEAL_II_LIBRARIES_RELEASE})
  endif()
  # The linker keeps of deal.II's long list only what is called: a tool that starts fast.
  target_link_options(swimtwin_dealii INTERFACE -Wl,--as-needed)
  target_link_libraries(swimtwin_dealii INTERFACE ${SWIMTWIN_DEAL_II_LIBRARIES} MPI::MPI_CXX)
endif()
