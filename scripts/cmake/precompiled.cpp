// Nothing but the standard headers that CMake puts in front: they are compiled here once for all libraries.
