"""Random programs of GLSL ES 1.00, and mutations of given ones; the same for the same seed."""
import random
import re

SCALARS = ["float", "int", "bool"]
VECTORS = {"float": "vec", "int": "ivec", "bool": "bvec"}
TYPES = SCALARS + [v + str(n) for v in VECTORS.values() for n in (2, 3, 4)] + ["mat2", "mat3", "mat4"]
COMMON = ["float"] * 6 + ["vec3"] * 4 + ["vec4"] * 3 + ["vec2"] * 2 + ["int", "bool"] + TYPES
UNARY = "radians degrees sin cos tan asin acos atan exp log exp2 log2 sqrt inversesqrt abs sign floor ceil fract normalize".split()
BINARY = "atan pow mod min max step reflect".split()
TERNARY = "clamp mix smoothstep faceforward".split()
LATER = "round trunc inverse transpose texture saturate dFdx texture2DLod".split()


def scalar_of(kind):
    return {"v": "float", "m": "float", "i": "int", "b": "bool", "f": "float"}[kind[0]] if kind not in SCALARS else kind


def size_of(kind):
    return 1 if kind in SCALARS else int(kind[-1])


class Program:
    """A text whose parts fit, but for `slips` in a thousand choices."""

    def __init__(self, seed, slips=8):
        self.random = random.Random(seed)
        self.slips = slips
        self.scopes = [{}]
        self.functions = []
        self.count = 0
        self.stage = self.random.choice(["vert", "frag"])

    def some(self, choices):
        return self.random.choice(choices)

    def slip(self):
        return self.random.randrange(1000) < self.slips

    def name(self, kind, prefix="v"):
        self.count += 1
        name = f"{prefix}{self.count}"
        if self.slip():
            name = self.some(["gl_x", "a__b", "float", "main", "sin", "half", "v1"])
        self.scopes[-1][name] = kind
        return name

    def literal(self, kind):
        if kind == "bool":
            return self.some(["true", "false"])
        if kind == "int":
            return self.some(["0", "1", "2", "3", "7", "0x1F", "010", str(self.random.randrange(100))])
        return self.some(["0.0", "1.0", "0.5", ".25", "2.", "1e-3", "3.5E2", f"{self.random.random():.4g}"])

    def variable(self, kind):
        names = [name for scope in self.scopes for name, of in scope.items() if of == kind]
        return self.some(names) if names else None

    def expression(self, kind, depth=3):
        if self.slip():
            kind = self.some(TYPES)
        if depth <= 0 or self.random.random() < 0.2:
            name = self.variable(kind)
            if name and self.random.random() < 0.8:
                return name
            if kind in SCALARS:
                return self.literal(kind)
            depth = 0
        makers = [self.constructor, self.constructor, self.conditional, self.swizzle, self.call]
        if scalar_of(kind) != "bool":
            makers += [self.arithmetic] * 5 + [self.sign]
        else:
            makers += [self.logic] * 3
        if kind in ("float", "vec2", "vec3", "vec4"):
            makers += [self.built_in] * 4
        if depth <= 0:
            makers = [self.constructor]
        return self.some(makers)(kind, depth - 1)

    def constructor(self, kind, depth):
        size, base = size_of(kind), scalar_of(kind)
        if kind in SCALARS:
            return f"{kind}({self.expression(self.some(SCALARS), depth)})" if depth > 0 else self.literal(kind)
        if kind.startswith("mat"):
            parts = [self.expression(f"vec{size}", depth) for _ in range(size)]
            return f"{kind}({', '.join(parts)})" if self.random.random() < 0.7 else f"{kind}({self.literal('float')})"
        parts, left = [], size
        if self.random.random() < 0.25:
            return f"{kind}({self.expression(base, depth)})"
        while left > 0:
            n = self.random.randint(1, left)
            parts.append(self.expression(base if n == 1 else VECTORS[base] + str(n), depth))
            left -= n
        if self.slip():
            parts.append(self.literal(base))
        return f"{kind}({', '.join(parts)})"

    def conditional(self, kind, depth):
        return f"({self.expression('bool', depth)} ? {self.expression(kind, depth)} : {self.expression(kind, depth)})"

    def swizzle(self, kind, depth):
        if kind.startswith("mat"):
            return self.constructor(kind, depth)
        size, base = size_of(kind), scalar_of(kind)
        source = self.random.randint(2, 4)
        letters = self.some(["xyzw", "rgba", "stpq"])[: source + self.slip()]
        picked = "".join(self.some(letters) for _ in range(size))
        return f"{self.primary(VECTORS[base] + str(source), depth)}.{picked}"

    def primary(self, kind, depth):
        return self.variable(kind) or self.constructor(kind, depth)

    def arithmetic(self, kind, depth):
        base, operator = scalar_of(kind), self.some("+-*/")
        sides = [kind, kind] if kind in SCALARS else self.some([[kind, kind], [kind, base], [base, kind]])
        if operator == "*" and kind in ("vec2", "vec3", "vec4") and self.random.random() < 0.4:
            sides = self.some([["mat" + kind[-1], kind], [kind, "mat" + kind[-1]]])
        if self.slip():
            operator = self.some(["%", "<<", "&", "|", "^"])
        return f"({self.expression(sides[0], depth)} {operator} {self.expression(sides[1], depth)})"

    def sign(self, kind, depth):
        return f"{self.some('-+')}{self.primary(kind, depth)}"

    def logic(self, kind, depth):
        if kind != "bool":
            size, of = kind[-1], self.some(["vec", "ivec"])
            function = self.some(["lessThan", "greaterThan", "lessThanEqual", "equal", "notEqual"])
            return f"{function}({self.expression(of + size, depth)}, {self.expression(of + size, depth)})"
        choice = self.random.randrange(4)
        if choice == 0:
            of = self.some(["float", "int"])
            return f"({self.expression(of, depth)} {self.some(['<', '>', '<=', '>='])} {self.expression(of, depth)})"
        if choice == 1:
            of = self.some(TYPES)
            return f"({self.expression(of, depth)} {self.some(['==', '!='])} {self.expression(of, depth)})"
        if choice == 2:
            return f"!{self.primary('bool', depth)}"
        return f"({self.expression('bool', depth)} {self.some(['&&', '||', '^^'])} {self.expression('bool', depth)})"

    def built_in(self, kind, depth):
        def make(*kinds):
            return ", ".join(self.expression(one, depth) for one in kinds)

        if self.slip():
            return f"{self.some(LATER)}({make(kind)})"
        choice = self.random.randrange(5)
        if kind == "float" and choice == 0:
            of = self.some(["vec2", "vec3", "vec4"])
            return self.some([f"dot({make(of, of)})", f"length({make(of)})", f"distance({make(of, of)})"])
        if choice == 1:
            return f"{self.some(BINARY)}({make(kind, kind)})"
        if choice == 2:
            return f"{self.some(TERNARY)}({make(kind, kind, kind)})"
        if choice == 3 and kind == "vec3":
            return f"cross({make(kind, kind)})"
        if choice == 4:
            return f"{self.some(['mod', 'min', 'max'])}({make(kind, 'float')})"
        return f"{self.some(UNARY)}({make(kind)})"

    def call(self, kind, depth):
        fitting = [one for one in self.functions if one[1] == kind]
        if not fitting:
            return self.primary(kind, depth)
        name, _, parameters = self.some(fitting)
        return f"{name}({', '.join(self.expression(of, depth) for of in parameters)})"

    def statement(self, depth, loop=False):
        choice = self.random.randrange(14)
        kind = self.some(COMMON)
        if choice < 5:
            value = self.expression(kind)
            return f"{self.qualified(kind)} {self.name(kind)} = {value};"
        if choice < 8:
            name = self.variable(kind)
            return f"{name} {self.some(['=', '=', '+=', '*=']) if scalar_of(kind) != 'bool' else '='} {self.expression(kind)};" if name else ";"
        if choice == 8 and depth > 0:
            other = f" else {self.block(depth - 1, loop)}" if self.random.random() < 0.5 else ""
            return f"if ({self.expression('bool', 2)}) {self.block(depth - 1, loop)}{other}"
        if choice == 9 and depth > 0:
            self.scopes.append({})
            index = self.name("int", "i")
            text = f"for (int {index} = 0; {index} < {self.random.randint(1, 9)}; {self.some(['++' + index, index + '++', index + ' += 2'])}) {self.block(depth - 1, True, False)}"
            self.scopes.pop()
            return text
        if choice == 10:
            name = self.name("float", "a")
            del self.scopes[-1][name]
            return f"float {name}[{self.random.randint(0 if self.slip() else 1, 4)}]; {name}[0] = {self.expression('float')};"
        if choice == 11 and (loop or self.slip()):
            return self.some(["break;", "continue;"])
        if choice == 12 and (self.stage == "frag" or self.slip()):
            return f"if ({self.expression('bool', 1)}) discard;"
        name = self.variable("vec4")
        return f"{name}.{self.some(['x', 'yz', 'rgb', 'zyxw'] + ['xx'] * self.slip())} *= {self.literal('float')};" if name else ";"

    def qualified(self, kind):
        precision = self.some(["", "", "", "lowp ", "mediump ", "highp "])
        return kind if scalar_of(kind) == "bool" and not self.slip() else precision + kind

    def block(self, depth, loop=False, scope=True):
        self.scopes.append({})
        lines = [self.statement(depth, loop) for _ in range(self.random.randint(1, 4))]
        self.scopes.pop()
        return "{\n" + "\n".join(lines) + "\n}"

    def function(self):
        kind, parameters = self.some(COMMON), []
        self.scopes.append({})
        texts = []
        for _ in range(self.random.randint(0, 3)):
            of = self.some(COMMON)
            texts.append(f"{self.some(['', '', 'in ', 'const '])}{self.qualified(of)} {self.name(of, 'p')}")
            parameters.append(of)
        self.count += 1
        name = f"f{self.count}"
        body = "\n".join(self.statement(2) for _ in range(self.random.randint(0, 4)))
        text = f"{kind} {name}({', '.join(texts)})\n{{\n{body}\n" + ("" if self.slip() else f"return {self.expression(kind)};\n") + "}"
        self.scopes.pop()
        self.functions.append((name, kind, parameters))
        return text

    def globals(self):
        for _ in range(self.random.randint(1, 5)):
            kind = self.some(["float", "vec2", "vec3", "vec4", "mat3", "mat4"])
            storage = self.some(["uniform", "varying", "const", ""] + ["attribute"] * (self.stage == "vert" or self.slip()))
            if storage == "const" or not storage:
                yield f"{storage} {kind} {self.name(kind, 'g')} = {self.constructor(kind, 0)};"
            else:
                name = self.name(kind, "g")
                if storage != "varying" or self.stage != "vert":
                    self.scopes[0].pop(name)
                    self.scopes[0][name] = kind if storage == "uniform" and self.slip() else "read-only " + kind
                yield f"{storage} {kind} {name};"

    def text(self):
        parts = ["#version 100"]
        if self.stage == "frag" and not self.slip():
            parts.append(f"precision {self.some(['highp', 'mediump', 'lowp'])} float;")
        if self.random.random() < 0.3:
            parts.append(f"#define N {self.random.randint(0, 3)}\n#if N > 1 && defined(N)\nfloat unused = float(N);\n#elif N == 1\n#else\nint unused;\n#endif")
        if self.random.random() < 0.3:
            parts.append("#define SQUARE(x) ((x) * (x))\nfloat squared(float x) { return SQUARE(x); }")
            self.functions.append(("squared", "float", ["float"]))
        parts += self.globals()
        parts += [self.function() for _ in range(self.random.randint(0, 3))]
        out = "gl_Position" if self.stage == "vert" else "gl_FragColor"
        self.scopes.append({})
        body = "\n".join(self.statement(2) for _ in range(self.random.randint(1, 6)))
        parts.append(f"void main()\n{{\n{body}\n{out} = {self.expression('vec4')};\n}}")
        return "\n".join(parts) + "\n"


TOKEN = re.compile(r"[A-Za-z_]\w*|\d*\.\d+(?:[eE][-+]?\d+)?|\d+\.?(?:[eE][-+]?\d+)?|<=|>=|==|!=|&&|\|\||\^\^|\+\+|--|[-+*/]=|\S")
OTHERS = ("( ) { } [ ] ; , . + - * / = == < > ? : ! && || ++ 0 1 2.0 0.5 int float vec2 vec3 vec4 mat4 bool void const uniform varying "
          "attribute in out highp if else for return discard xyz x rgb gl_FragColor gl_Position main normalize dot max 1.0f % & texture "
          "struct precision #define #if #endif").split()


def mutate(text, seed):
    """One to three tokens deleted, doubled, exchanged, replaced, or a number made an int or a float."""
    chance = random.Random(seed)
    for _ in range(chance.choice([1, 1, 1, 2, 3])):
        tokens = [match.span() for match in TOKEN.finditer(text)]
        first, last = chance.choice(tokens)
        token = text[first:last]
        way = chance.randrange(6)
        if way == 0:
            new = ""
        elif way == 1:
            new = f"{token} {token}"
        elif way == 2:
            a, b = chance.choice(tokens)
            new = text[a:b]
        elif way == 3:
            new = chance.choice(OTHERS)
        elif way == 4 and re.fullmatch(r"\d+\.\d*", token):
            new = token.split(".")[0] or "0"
        elif way == 4 and token.isdigit():
            new = token + ".0"
        elif len(token) > 2:
            i = chance.randrange(len(token) - 1)
            new = token[:i] + token[i + 1] + token[i] + token[i + 2 :]
        else:
            new = chance.choice(OTHERS)
        text = text[:first] + new + text[last:]
    return text
