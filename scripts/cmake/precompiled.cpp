// Nothing but the headers that CMake puts in front: they are compiled here once for all files that are
// compiled alike.
