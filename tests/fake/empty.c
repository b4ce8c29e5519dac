/* A library with the right name but none of the functions. */
int glintFakeEmpty = 0;
