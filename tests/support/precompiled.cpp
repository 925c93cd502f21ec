// Nothing but GoogleTest's header, which CMake compiles here once for all tests. It is the only precompiled one: a test
// still names every other header that it needs.
