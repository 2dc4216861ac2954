//! Recursive descent, one function per level:
//!
//! ```text
//! sum     = product (("+" | "-") product)*
//! product = signed (("*" | "/") signed)*
//! signed  = ("+" | "-") signed | power
//! power   = operand ("^" signed)?              so −x^2 = −(x^2) and 2^3^2 = 2^(3^2)
//! operand = number | name | function "(" sum ("," sum)? ")" | "(" sum ")"
//! ```

use super::Fault;
use super::name::{Function, Variable, constant};
use super::token::{Token, Tokens};
use super::tree::{Binary, Tree};

/// Longest text and deepest nesting that is read: far more than a law needs, far less than exhausts the stack.
const LONGEST: usize = 1000;
const DEEPEST: usize = 50;

pub fn parse(text: &str, parameters: &[&str], variables: &[Variable]) -> Result<Tree, Fault> {
    let length = text.chars().count();
    if length > LONGEST {
        return Err(Fault {
            position: LONGEST + 1,
            found: format!("{length} characters"),
            allowed: format!("at most {LONGEST}"),
        });
    }
    let mut tokens = Tokens::new(text);
    let (token, position) = tokens.next()?;
    let mut parser = Parser {
        tokens,
        token,
        position,
        depth: 0,
        parameters,
        variables,
    };
    let tree = parser.sum()?;
    match parser.token {
        Token::End => Ok(tree),
        _ => Err(parser.fault("+ - * / ^ or the end")),
    }
}

struct Parser<'a> {
    tokens: Tokens<'a>,
    /// The token that comes next, and the character at which it begins.
    token: Token<'a>,
    position: usize,
    depth: usize,
    parameters: &'a [&'a str],
    variables: &'a [Variable],
}

impl<'a> Parser<'a> {
    fn sum(&mut self) -> Result<Tree, Fault> {
        let mut tree = self.product()?;
        loop {
            let operator = match self.token {
                Token::Symbol('+') => Binary::Add,
                Token::Symbol('-') => Binary::Subtract,
                _ => return Ok(tree),
            };
            self.advance()?;
            tree = Tree::binary(operator, tree, self.product()?);
        }
    }

    fn product(&mut self) -> Result<Tree, Fault> {
        let mut tree = self.signed()?;
        loop {
            let operator = match self.token {
                Token::Symbol('*') => Binary::Multiply,
                Token::Symbol('/') => Binary::Divide,
                _ => return Ok(tree),
            };
            self.advance()?;
            tree = Tree::binary(operator, tree, self.signed()?);
        }
    }

    fn signed(&mut self) -> Result<Tree, Fault> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.fault(&format!("at most {DEEPEST} levels of nesting")));
        }
        let tree = match self.token {
            Token::Symbol('-') => {
                self.advance()?;
                Tree::negative(self.signed()?)
            }
            Token::Symbol('+') => {
                self.advance()?;
                self.signed()?
            }
            _ => self.power()?,
        };
        self.depth -= 1;
        Ok(tree)
    }

    fn power(&mut self) -> Result<Tree, Fault> {
        let base = self.operand()?;
        if self.token != Token::Symbol('^') {
            return Ok(base);
        }
        self.advance()?;
        Ok(Tree::binary(Binary::Power, base, self.signed()?))
    }

    fn operand(&mut self) -> Result<Tree, Fault> {
        match self.token {
            Token::Number(value) => {
                self.advance()?;
                Ok(Tree::Constant(value))
            }
            Token::Name(name) => self.named(name),
            Token::Symbol('(') => {
                self.advance()?;
                let tree = self.sum()?;
                self.expect(')', "+ - * / ^ or `)`")?;
                Ok(tree)
            }
            _ => Err(self.fault("a number, a name or `(`")),
        }
    }

    fn named(&mut self, name: &'a str) -> Result<Tree, Fault> {
        if let Some(index) = self.parameters.iter().position(|known| *known == name) {
            self.advance()?;
            return Ok(Tree::Parameter(index));
        }
        if let Some(variable) = self.variables.iter().find(|known| known.name() == name) {
            self.advance()?;
            return Ok(Tree::Variable(*variable));
        }
        if let Some(value) = constant(name) {
            self.advance()?;
            return Ok(Tree::Constant(value));
        }
        let Some(function) = Function::named(name) else {
            return Err(self.fault(&self.known()));
        };
        self.advance()?;
        self.expect('(', &format!("`(` after the function `{name}`"))?;
        let first = self.sum()?;
        let call = match Binary::of_function(function) {
            Some(operator) => {
                self.expect(',', "`,`: the function takes two values")?;
                Tree::binary(operator, first, self.sum()?)
            }
            None => Tree::call(function, first),
        };
        self.expect(')', "+ - * / ^ or `)`")?;
        Ok(call)
    }

    /// Every name that may stand in this expression.
    fn known(&self) -> String {
        let variables: Vec<&str> = self.variables.iter().map(|known| known.name()).collect();
        let functions = Function::ALL.map(Function::name);
        format!(
            "a parameter ({}), a variable ({}), pi or a function ({})",
            if self.parameters.is_empty() {
                "none is declared".to_owned()
            } else {
                self.parameters.join(", ")
            },
            variables.join(", "),
            functions.join(", ")
        )
    }

    fn expect(&mut self, symbol: char, allowed: &str) -> Result<(), Fault> {
        if self.token == Token::Symbol(symbol) {
            self.advance()
        } else {
            Err(self.fault(allowed))
        }
    }

    fn advance(&mut self) -> Result<(), Fault> {
        (self.token, self.position) = self.tokens.next()?;
        Ok(())
    }

    fn fault(&self, allowed: &str) -> Fault {
        Fault {
            position: self.position,
            found: self.token.shown(),
            allowed: allowed.to_owned(),
        }
    }
}
