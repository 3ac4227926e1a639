//! CONFIGURATION, RESOURCE, TASK and program instances.
//! From: IEC 61131-3 §6.8.2 (language reference §10.1).

use super::cursor::Parser;
use crate::syntax::ast::{Configuration, Expr, ExprKind, Name, ProgramDecl, Resource, TaskDecl};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use takt_base::Span;
use takt_base::diag::{Code, Diag};

impl Parser<'_> {
    /// CONFIGURATION ... END_CONFIGURATION; the keyword is the current token.
    pub(super) fn configuration(&mut self) -> Configuration {
        let opener = self.here();
        self.bump();
        let name = self.head_name("the name of the configuration", opener);
        let mut configuration =
            Configuration { name, globals: Vec::new(), resources: Vec::new(), config: Vec::new(), access: Vec::new() };
        let mut direct = empty_resource(None);
        while !self.at_end() && self.kw() != Kw::EndConfiguration {
            match self.kw() {
                Kw::Resource => configuration.resources.extend(self.resource()),
                Kw::VarConfig => configuration.config.extend(self.var_config()),
                Kw::VarAccess => configuration.access.extend(self.var_access()),
                kw if kw.is_section() => configuration.globals.extend(self.var_section()),
                kw if ends_resource(kw) => break,
                _ => self.resource_member(&mut direct),
            }
        }
        if !direct.tasks.is_empty() || !direct.programs.is_empty() {
            self.check_direct(&direct, &configuration);
            configuration.resources.insert(0, direct);
        }
        configuration.access.append(&mut self.access_paths);
        self.close_declaration(Kw::EndConfiguration, opener, "CONFIGURATION");
        configuration
    }

    /// Tasks and programs stand in the configuration, or in its resources.
    fn check_direct(&mut self, direct: &Resource, configuration: &Configuration) {
        let first = direct.tasks.iter().map(|t| &t.name).chain(direct.programs.iter().map(|p| &p.name)).next();
        if let (Some(name), false) = (first, configuration.resources.is_empty()) {
            let diag = Diag::new(Code::Expected, name.span, "outside of the resources");
            let diag = diag.message("tasks and programs stand in the CONFIGURATION or in its RESOURCEs, not in both");
            self.soft(diag.help("move it into a RESOURCE"));
        }
    }

    fn head_name(&mut self, what: &str, opener: Span) -> Name {
        let name = self.declared_name(what);
        if self.lost {
            self.skip_head();
        }
        name.unwrap_or(Name { text: String::new(), span: opener.end_point() })
    }

    fn resource(&mut self) -> Option<Resource> {
        let opener = self.here();
        self.bump();
        let mut resource = empty_resource(Some(self.head_name("the name of the resource", opener)));
        if self.eat_kw(Kw::On) {
            self.resource_type();
        }
        while !self.at_end() && self.kw() != Kw::EndResource {
            match self.kw() {
                kw if kw.is_section() => resource.globals.extend(self.var_section()),
                kw if ends_resource(kw) || kw == Kw::Resource => break,
                _ => self.resource_member(&mut resource),
            }
        }
        self.close_declaration(Kw::EndResource, opener, "RESOURCE");
        Some(resource)
    }

    /// The name of a controller, which means nothing here: any name does.
    fn resource_type(&mut self) {
        let mut named = self.eat(Tok::Word);
        while named && self.eat(Tok::Dot) {
            named = self.eat(Tok::Word);
        }
        if !named {
            self.expected("the type of the resource, for example PLC");
            self.skip_head();
        }
    }

    /// A task or a program, with its `;`.
    fn resource_member(&mut self, resource: &mut Resource) {
        match self.kw() {
            Kw::Task => resource.tasks.extend(self.task()),
            Kw::Program => resource.programs.extend(self.program_instance()),
            _ if self.eat(Tok::Semi) => return,
            _ => {
                self.expected("TASK or PROGRAM");
                self.bump();
            }
        }
        if self.lost {
            self.skip_declaration();
        } else if !self.eat(Tok::Semi) {
            self.missing_semicolon("this line");
        }
    }

    fn task(&mut self) -> Option<TaskDecl> {
        self.bump();
        let name = self.declared_name("the name of the task")?;
        let mut task = TaskDecl { name, single: None, interval: None, priority: None };
        let paren = self.here();
        if !self.expect(Tok::LParen, "`(` and the properties of the task") {
            return Some(task);
        }
        while self.at(Tok::Word) && !self.lost {
            self.task_property(&mut task);
            if !self.eat(Tok::Comma) {
                break;
            }
        }
        self.closing(Tok::RParen, ")", paren);
        Some(task)
    }

    fn task_property(&mut self, task: &mut TaskDecl) {
        let property = self.name();
        if property.key() == "MULTI" {
            let diag = Diag::new(Code::NotSupportedYet, property.span, "several triggers for one task");
            self.soft(diag.help("write a SINGLE, and set its variable where one of the signals rises"));
            self.lost = true;
            task.interval.get_or_insert(Expr { kind: ExprKind::Error, span: property.span });
            return;
        }
        if !self.expect(Tok::Assign, "`:=` and the value of the property") {
            return;
        }
        let value: Expr = self.expr();
        let slot = match property.key().as_str() {
            "SINGLE" => &mut task.single,
            "INTERVAL" => &mut task.interval,
            "PRIORITY" => &mut task.priority,
            _ => {
                let diag = Diag::new(Code::Expected, property.span, "not a property of a task");
                self.soft(diag.message("expected SINGLE, INTERVAL or PRIORITY"));
                return;
            }
        };
        if slot.replace(value).is_some() {
            let diag = Diag::new(Code::DuplicateName, property.span, format!("{} is given twice", property.text));
            self.soft(diag);
        }
    }

    fn program_instance(&mut self) -> Option<ProgramDecl> {
        self.bump();
        let retain = match self.kw() {
            Kw::Retain => Some(true),
            Kw::NonRetain => Some(false),
            _ => None,
        };
        if retain.is_some() {
            self.bump();
        }
        let name = self.declared_name("the name of the program instance")?;
        let task = if self.eat_kw(Kw::With) { Some(self.declared_name("the name of a task")?) } else { None };
        if !self.colon("the type of the program") {
            return None;
        }
        let ty = self.declared_name("the name of a PROGRAM")?;
        let ty = self.qualified(ty);
        let mut program = ProgramDecl { name, retain, task, ty, connections: Vec::new(), blocks: Vec::new() };
        if self.at(Tok::LParen) {
            self.connections(&mut program);
        }
        Some(program)
    }

    /// `(in := value, out => variable, fb WITH task)`; the opening parenthesis is the current token.
    fn connections(&mut self, program: &mut ProgramDecl) {
        let paren = self.here();
        self.bump();
        while !self.at(Tok::RParen) && !self.lost {
            if self.at(Tok::Word) && self.nth(1).kw == Kw::With {
                program.blocks.extend(self.block_task());
            } else {
                program.connections.push(self.connection());
            }
            if !self.eat(Tok::Comma) {
                break;
            }
        }
        self.closing(Tok::RParen, ")", paren);
    }

    fn block_task(&mut self) -> Option<(Name, Name)> {
        let block = self.declared_name("the name of a function block")?;
        self.bump();
        Some((block, self.declared_name("the name of a task")?))
    }
}

fn empty_resource(name: Option<Name>) -> Resource {
    Resource { name, globals: Vec::new(), tasks: Vec::new(), programs: Vec::new() }
}

/// True if a resource can't go on here.
fn ends_resource(kw: Kw) -> bool {
    kw.ends_declaration() || matches!(kw, Kw::Configuration | Kw::Function | Kw::FunctionBlock | Kw::Type)
}
