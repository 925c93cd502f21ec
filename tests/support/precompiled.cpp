// Nothing but GoogleTest's header, which CMake compiles here once for all tests. A test still names every
// other header that it needs.
