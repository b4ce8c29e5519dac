/* A library of the right name with none of the functions. */
int glintFakeEmpty = 0;
