"""The models: one module each, the short ones in `estimates`; functions of plain floats, one case.

`arrays` compiles the same functions for many cases at once and checks what they are given.
"""
