// tinygltf's own code, compiled with the fuzz target's instruments.
#define TINYGLTF_IMPLEMENTATION
#pragma clang diagnostic ignored "-Weverything"
#include <tiny_gltf.h>
