// Counters, and lines that may be visible (gl.h).
struct Candidate {
    uint line, a, edge, b, k0, k1, seen, level;
};
