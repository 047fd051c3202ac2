"""What builds the package and is no part of it: C's headers in, a cdef, an extension and
dataclasses out."""
