# Interface target with the flags of every target of ours. Warnings are errors. (Shadowing: of locals only, because files
# that are compiled as one see each other's constants.)
add_library(swimtwin_flags INTERFACE)
target_compile_options(swimtwin_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow=local -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
target_include_directories(swimtwin_flags INTERFACE ${CMAKE_SOURCE_DIR})
if(SWIMTWIN_SANITIZE)
  # GCC 12 takes parts of std::regex for uninitialised where it instruments them.
  target_compile_options(swimtwin_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer -Wno-maybe-uninitialized)
  target_link_options(swimtwin_flags INTERFACE -fsanitize=address,undefined)
  # As in Debian's libraries: under AddressSanitizer Eigen would align by itself, and gmsh, which calls some of our
  # instances of Eigen's templates, frees what they allocate with free().
  target_compile_definitions(swimtwin_flags INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
