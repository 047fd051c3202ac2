// An added polygon that the depth test leaves: 1 + its class.
layout(location = 0) out uint ink;
flat in uint line;
void main() { ink = (line & 7u) + 1u; }
