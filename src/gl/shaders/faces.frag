// Which triangle a sample shows.
layout(location = 0) out uint id;
flat in uint triangle;
void main() { id = triangle + 1u; }
